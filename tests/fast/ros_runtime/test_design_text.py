"""A design is read as written, and missing facts are named."""

from __future__ import annotations

import xml.etree.ElementTree as ET

import pytest

from ros_runtime.design import Design, Link, read_design
from ros_runtime.drawing.design_graph import MOST_LINKS, design_svg

WHOLE = """
# An arm.

camera -> finder : topic sensor_msgs/msg/Image   # need 1
    qos: best effort,
        keep last 1
    rate: 15 Hz
    failure: after 0.5 s: the finder says so
    Safety: it moves nothing

button -> relay : wire 24 V in two channels
    rate: constant
    failure: a torn cable opens it
    safety: no program is on the way
"""
BOX = "{http://www.w3.org/2000/svg}rect"


def missing(text: str) -> list[str]:
    """The missing facts of the only link of a readable design."""
    design = read_design(text)
    assert design.problems == ()
    (link,) = design.links
    return link.missing()


def link(pattern: str = "topic", type: str = "std_msgs/msg/Empty", **facts: str) -> str:
    said = {"qos": "reliable", "rate": "1 Hz", "failure": "none for 2 s", "safety": "moves nothing"} | facts
    return "\n".join([f"a -> b : {pattern} {type}", *(f"  {name}: {text}" for name, text in said.items())])


def test_links_nodes_and_facts_are_read() -> None:
    design = read_design(WHOLE)
    assert design.problems == ()
    assert design.nodes == ("camera", "finder", "button", "relay")
    camera, button = design.links
    assert (camera.sender, camera.receiver, camera.pattern) == ("camera", "finder", "topic")
    assert camera.type == "sensor_msgs/msg/Image"
    assert camera.facts == {
        "qos": "best effort, keep last 1",
        "rate": "15 Hz",
        "failure": "after 0.5 s: the finder says so",
        "safety": "it moves nothing",
    }
    assert (button.pattern, button.type) == ("wire", "24 V in two channels")
    assert camera.missing() == button.missing() == []


@pytest.mark.parametrize("fact", ["qos", "rate", "failure", "safety"])
@pytest.mark.parametrize("text", ["", "…", "?", "-"])
def test_an_empty_fact_is_missing(fact: str, text: str) -> None:
    assert missing(link(**{fact: text})) == [f"{fact} is missing"]


def test_a_wire_needs_no_qos_but_a_description() -> None:
    assert missing(link("wire", "24 V", qos="")) == []
    assert missing(link("wire", "")) == ["type is missing: say what the wire carries"]


@pytest.mark.parametrize(
    ("pattern", "type"),
    [
        ("topic", "sensor_msgs/msg/Image"),
        ("topic", "sensor_msgs/Image"),
        ("service", "std_srvs/srv/SetBool"),
        ("action", "control_msgs/action/FollowJointTrajectory"),
    ],
)
def test_the_name_of_a_type_fits_its_pattern(pattern: str, type: str) -> None:
    assert missing(link(pattern, type)) == []


@pytest.mark.parametrize(
    ("pattern", "type", "kind"),
    [
        ("topic", "std_srvs/srv/SetBool", "msg"),
        ("service", "sensor_msgs/msg/Image", "srv"),
        ("action", "FollowJointTrajectory", "action"),
        ("topic", "", "msg"),
        ("topic", "sensor_msgs/msg/Image and more", "msg"),
    ],
)
def test_a_type_of_another_kind_is_named(pattern: str, type: str, kind: str) -> None:
    assert missing(link(pattern, type)) == [
        f"type: expected the full name PACKAGE/{kind}/NAME after {pattern!r}, got {type!r}"
    ]


def test_an_unknown_pattern_is_named() -> None:
    assert missing(link("stream"))[0] == "pattern: expected one of topic, service, action, wire, got 'stream'"


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("camera to finder", "line 1: expected a link such as"),
        ("a -> b : topic x/msg/Y\n  saftey: none", "line 2: expected one of qos, rate, failure, safety"),
        ("a -> b : topic x/msg/Y\n  rate: 1 Hz\n  rate: 2 Hz", "line 3: a -> b already has rate"),
    ],
)
def test_a_line_that_cannot_be_read_is_named(text: str, problem: str) -> None:
    (found,) = read_design(text).problems
    assert found.startswith(problem)


def test_lines_indented_below_an_unreadable_link_are_ignored() -> None:
    assert len(read_design("camera to finder\n  rate: 15 Hz\n  qos: x").problems) == 1


@pytest.mark.parametrize(
    "text", ["", "\0", "\t->", " a -> b", "->:", "a -> b :", "é" * 10_000, "a->b:c" * 999]
)
def test_any_text_is_read_without_an_error(text: str) -> None:
    assert isinstance(read_design(text), Design)


def test_a_drawing_shows_nodes_and_links_and_marks_what_lacks_a_fact() -> None:
    design = read_design(WHOLE + "\nfinder -> arm : topic geometry_msgs/msg/PoseStamped\n  rate: 15 Hz\n")
    svg = design_svg(design, title="An arm & a camera")
    assert "<title>An arm &amp; a camera</title>" in svg
    assert "camera -&gt; finder: topic sensor_msgs/msg/Image." in svg
    assert svg.count('stroke="#c0392b"') == 3  # both lines of the last link, and the legend
    assert ">lacks a fact</text>" in svg
    assert "lacks a fact" not in design_svg(read_design(WHOLE), title="Nothing lacks")
    root = ET.fromstring(svg)
    nodes_left, links, nodes_right = 3, 3, 3
    assert len(root.findall(BOX)) == 1 + nodes_left + links + nodes_right


def test_text_of_a_design_is_escaped() -> None:
    svg = design_svg(read_design("a -> b : topic <script>alert(1)</script>"), title="<b>")
    assert "<script>" not in svg
    ET.fromstring(svg)


def test_the_number_of_drawn_links_is_limited() -> None:
    many = Design(tuple(Link(f"n{number}", "sink", "topic", "x/msg/Y") for number in range(500)))
    assert design_svg(many, title="many").count("rx=") == MOST_LINKS + 1


def test_an_empty_design_cannot_be_drawn() -> None:
    with pytest.raises(ValueError, match="at least one link"):
        design_svg(read_design(""), title="nothing")
