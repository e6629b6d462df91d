"""The criteria by which a person marks the design, and the drawing of it for that person."""

from __future__ import annotations

from collections.abc import Mapping

from autograder.authoring import Criterion
from ros_runtime.design import read_design
from ros_runtime.drawing.design_graph import design_svg

from . import FILES


def on_links(every: str, *, or_none: str = "") -> dict[int, str]:
    """Return the levels of a criterion about every link; `or_none` is another reason for 0 points."""
    fewer = f"fewer links do{f', or {or_none}' if or_none else ''}"
    return {3: every, 2: "all links but one do", 1: "at least half of the links do", 0: fewer}


CRITERIA = (
    Criterion(
        "graph",
        "The graph",
        {
            2: "every need has a link, and each link starts at its publisher or client",
            1: "one need has no link, or one link points the wrong way",
            0: "more than one such fault",
        },
    ),
    Criterion(
        "pattern",
        "Pattern",
        on_links(
            "every link has the pattern that its need requires, and `wire` where ROS cannot guarantee the time"
        ),
    ),
    Criterion(
        "type",
        "Type",
        on_links(
            "every link has the full name of a suitable standard type, or a custom type with fields, units and frame; "
            "every wire says which signal it carries"
        ),
    ),
    Criterion(
        "qos",
        "QoS",
        on_links(
            "every ROS link gives reliability, durability and depth, or says that they are the defaults; with a reason "
            "if they are not"
        ),
    ),
    Criterion(
        "rate",
        "Rate",
        on_links("every link gives its rate as a number, and says where the number comes from"),
    ),
    Criterion(
        "failure",
        "Failure",
        on_links(
            "every link says which node detects that the other end is silent or wrong, how soon, and what it does"
        ),
    ),
    Criterion(
        "safety",
        "Safety",
        on_links(
            "every link says what harm it can do to a person or a thing, and every link that moves something stops it "
            "when the link fails",
            or_none="a function that must always work depends on an ordinary program, network or response "
            "(safety-rated ones count as a wire)",
        ),
    ),
)


def picture(sources: Mapping[str, str]) -> str | None:
    """Return a drawing (SVG) of the design, or None if it has no link that can be parsed."""
    (file,) = FILES
    design = read_design(sources.get(file, ""))
    return design_svg(design, title="The design that was handed in") if design.links else None
