import xml.etree.ElementTree as ElementTree

import pytest

from ros_runtime.drawing.sequence_diagram import Arrow, sequence_svg

SVG = "{http://www.w3.org/2000/svg}"


def test_a_diagram_shows_every_label_and_has_a_text_alternative():
    drawing = sequence_svg(
        [
            Arrow(1.0, "server", "client", "accepted", "answer"),
            Arrow(0.5, "client", "server", "goal <1>", "request"),
        ],
        title="A goal",
    )
    root = ElementTree.fromstring(drawing)
    texts = [element.text for element in root.iter(f"{SVG}text")]
    assert texts.index("goal <1>") < texts.index("accepted"), "time runs downwards"
    assert (
        root.find(f"{SVG}desc").text
        == "0.50 s: client to server: goal <1>. 1.00 s: server to client: accepted."
    )


def test_a_long_label_is_shown_whole_in_several_lines_above_its_arrow():
    label = "success True, message 'The robot is at x 0.00 m, y -0.01 m, heading 3 degrees'"
    drawing = sequence_svg(
        [Arrow(0.0, "client", "server", "ask"), Arrow(1.0, "server", "client", label)],
        title="A call",
        participants=("client", "server", "walker"),
    )
    texts = [*ElementTree.fromstring(drawing).iter(f"{SVG}text")]
    lines = [text for text in texts if text.text in label]
    assert len(lines) == 5
    assert " ".join(line.text for line in lines) == label
    asked = next(text for text in texts if text.text == "ask")
    heights = [int(text.get("y")) for text in (asked, *lines)]
    assert heights == sorted(set(heights)), "no line is on another"
    assert int(drawing.partition('width="')[2].partition('"')[0]) < 560, "it fits beside the robot's panel"


def test_an_empty_diagram_is_refused():
    with pytest.raises(ValueError, match="nothing has happened"):
        sequence_svg([], title="empty")


@pytest.mark.parametrize("odd", ["\x08", "\x00", "\ud800", "\uffff", "\x1b[2J"])
def test_characters_that_xml_does_not_allow_are_replaced(odd):
    drawing = sequence_svg([Arrow(1.0, "server", "client", f"<{odd}>")], title=odd)
    texts = [element.text for element in ElementTree.fromstring(drawing).iter(f"{SVG}text")]
    assert f"<\ufffd{odd[1:]}>" in texts
