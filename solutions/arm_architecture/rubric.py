"""By what the design is marked, and how the marker sees it drawn."""

from __future__ import annotations

from collections.abc import Mapping

from autograder.authoring import Criterion
from ros_runtime.design import read_design
from ros_runtime.drawing.design_graph import design_svg

from . import FILES


def on_links(every: str, *, or_none: str = "") -> dict[int, str]:
    """Three points for what every link should say; `or_none` is what else costs them all."""
    fewer = f"fewer do{f', or {or_none}' if or_none else ''}"
    return {3: every, 2: "all links but one do", 1: "at least half of them do", 0: fewer}


CRITERIA = (
    Criterion(
        "graph",
        "The graph",
        {
            2: "every need is served, and each link begins at the node that publishes or asks",
            1: "one need is not served, or one link points the wrong way",
            0: "more than one",
        },
    ),
    Criterion(
        "pattern",
        "Pattern",
        on_links(
            "every link has the pattern that its need decides, and `wire` where ROS cannot promise the time"
        ),
    ),
    Criterion(
        "type",
        "Type",
        on_links(
            "every link has a standard type that fits, by its full name, or a type of your own with fields, units and "
            "frame; a wire says what runs through it"
        ),
    ),
    Criterion(
        "qos",
        "QoS",
        on_links(
            "every link of ROS says reliability, durability and depth, or what the default is; and why, where it is "
            "not the default"
        ),
    ),
    Criterion(
        "rate",
        "Rate",
        on_links(
            "every link says how often something goes through it, as a number, and where the number comes from"
        ),
    ),
    Criterion(
        "failure",
        "Failure",
        on_links(
            "every link says who notices that the other end is silent or wrong, after how long, and what it does"
        ),
    ),
    Criterion(
        "safety",
        "Safety",
        on_links(
            "every link says what it can do to a person or a thing, and each that moves something fails towards "
            "standing still",
            or_none="what must always work depends on an ordinary program, network or answer (safety-rated ones count "
            "as a wire)",
        ),
    ),
)


def picture(sources: Mapping[str, str]) -> str | None:
    """Return the design as a drawing (SVG), if it has a link that can be read."""
    (file,) = FILES
    design = read_design(sources.get(file, ""))
    return design_svg(design, title="The design that was handed in") if design.links else None
