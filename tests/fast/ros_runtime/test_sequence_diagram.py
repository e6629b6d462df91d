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


def test_an_empty_diagram_is_refused():
    with pytest.raises(ValueError, match="nothing has happened"):
        sequence_svg([], title="empty")


@pytest.mark.parametrize("odd", ["\x08", "\x00", "\ud800", "\uffff", "\x1b[2J"])
def test_characters_that_xml_does_not_allow_are_replaced(odd):
    drawing = sequence_svg([Arrow(1.0, "server", "client", f"<{odd}>")], title=odd)
    texts = [element.text for element in ElementTree.fromstring(drawing).iter(f"{SVG}text")]
    assert f"<\ufffd{odd[1:]}>" in texts
