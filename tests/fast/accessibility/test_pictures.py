"""Every picture of notebooks, reports and pages has a text alternative, and letters that stand out in both themes."""

from __future__ import annotations

import base64
import math
import re
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import lab
from autograder.classroom.pages import plots
from humanoid_interfaces.action import WalkTo
from lab.client.interaction_log import log
from lab.pictures.labels import Mark
from lab.pictures.live_view import _LiveView
from lab.pictures.time_plot import Area, Curve, draw_panels
from lab.running.processes import ProcessHistory
from ros_runtime.drawing.columns import End, Row, columns_svg
from ros_runtime.drawing.design_graph import FILLS
from ros_runtime.drawing.sequence_diagram import Arrow, sequence_svg
from ros_runtime.drawing.svg import DARK_IN_JUPYTERLAB
from ros_runtime.record.client_events import GoalAnswered, GoalSent

PROJECT = Path(__file__).resolve().parents[3]
OUR_FOLDERS = (
    "autograder",
    "chapters",
    "course_cli",
    "lab",
    "robot_sim",
    "ros_cli",
    "ros_runtime",
    "solutions",
)
PICTURE = re.compile(
    r"<(?:img|svg|canvas|video|object)\b|\b(?:ipywidgets|display|widgets)\.(?:Image|Video)\(|image/(?:png|svg)"
)
# The only places where a picture gets its frame, and what they require of those who draw.
FRAMES = {
    "lab/pictures/picture.py": 'alt="{escape(words)}"',
    "autograder/report/notebook_table.py": 'alt="{}"',
    "autograder/report/templates/self_check.html": "{{ films[verdict.id] }}",  # a frame of notebook_table
    "autograder/report/templates/work.html": 'alt="The robot, with the events of the run as captions',
    "ros_runtime/drawing/svg.py": "<desc>{escape(words)}</desc>",
    "autograder/classroom/pages/plots.py": "<desc>{escape(words)}</desc>",
    "autograder/classroom/book/still_widgets.py": 'alt="{words}"',
    "autograder/classroom/nbgrader_bridge/cell_points.py": '"text/plain": DRAWING_REPLACEMENT',
}
MARKDOWN_PICTURE = re.compile(r"!\[(?P<words>[^\]]*)\]\(|<img\b(?P<html>[^>]*)>")
RUN = "100.00 T_0 beat begins\n100.01 T_0 beat awaits\n101.00 T_1 look begins\n104.00 T_1 look ends\n"


def test_only_frames_with_a_text_alternative_make_pictures() -> None:
    makers = {
        path.relative_to(PROJECT).as_posix()
        for folder in OUR_FOLDERS
        for path in (PROJECT / folder).rglob("*")
        if path.suffix in (".py", ".html", ".j2") and "known" not in path.parts
        if PICTURE.search(path.read_text(encoding="utf-8"))
    }
    assert makers == set(FRAMES)
    for path, words in FRAMES.items():
        assert words in (PROJECT / path).read_text(encoding="utf-8"), path


def test_the_live_view_is_described() -> None:
    state = _LiveView("track").widget.get_state()
    assert state["tooltip"] == "The robot"
    assert state["description"] == ""  # ipywidgets shows a title only beside an empty description


@pytest.mark.parametrize("folder", ["chapters", "exercises", "solutions", "docs"])
def test_pictures_of_pages_are_described(folder: str) -> None:
    pages = [page for kind in ("*.md", "*.ipynb") for page in (PROJECT / folder).rglob(kind)]
    for page in [*pages, PROJECT / "README.md"]:
        for found in MARKDOWN_PICTURE.finditer(page.read_text(encoding="utf-8")):
            words = found["words"] if found["words"] is not None else found["html"].partition("alt=")[2]
            assert len(words) > 20, f"{page}: {found[0]}"


def drawings() -> Iterator[tuple[str, str]]:
    """A drawing of every kind, as SVG, with its name."""
    arrows = [Arrow(at, "a", "b", "x", kind) for at, kind in enumerate(("request", "answer", "message"))]
    yield "sequence", sequence_svg([*arrows, Arrow(3.0, "a", "a", "a note")], title="t")
    rows = [Row("x", "T", [End("a", broken=True)], [End("b")], fill) for fill in FILLS.values()]
    yield "columns", columns_svg(rows, headings=("l", "m", "r"), title="t", words="w", broken_means="b")
    log.clear()
    log.append(GoalSent(t=1.0, goal="go 1", action="go", request=WalkTo.Goal()))
    log.append(GoalAnswered(t=1.1, goal="go 1", accepted=True))
    yield "goal states", lab.draw_goal_states().data
    log.clear()
    node: Any = SimpleNamespace(
        log=lambda: RUN, file=Path("a.py"), history=lambda: SimpleNamespace(ended=105.0)
    )
    gates = lab.draw_gates(node, {"beat": "one", "look": "two"}, threads=2)
    yield "gates", gates.children[0].value
    xs = np.linspace(0.0, 1.0, 5)
    curves = dict.fromkeys("abc", (xs, xs))
    yield "curves", lab.plot_curves(curves, "x", "y", factor=2.0).data
    marks = [Mark(0.3, "goal sent")]
    yield (
        "panels",
        draw_panels(
            [Curve("height", "m", 0.1, xs, xs)],
            seconds=1.0,
            marks=marks,
            changes=[Mark(0.5, "STANDING → WALKING")],
            compare={"a stone": lambda t: t},
            areas=[Area("silent", 0.2, 0.4)],
            title="t",
        ).data,
    )
    ended: Any = SimpleNamespace(history=lambda: ProcessHistory("a.py", 0.0, 2.0, "killed", marks))
    yield "timeline", lab.draw_timeline(ended).data
    yield "bars", plots.bars_svg({"a": 1}, title="t", across="x", up="y")
    for picture in (PROJECT / "chapters/images").glob("*.svg"):
        yield picture.name, picture.read_text(encoding="utf-8")


def test_letters_stand_out_on_a_light_and_on_a_dark_page() -> None:
    assert {name: weak for name, html in drawings() if (weak := weak_letters(html))} == {}


def weak_letters(html: str) -> list[str]:
    """The colours of letters whose contrast to a colour behind them is too low."""
    embedded = re.findall(r"data:image/svg\+xml;base64,([^\"]+)", html)
    texts = "".join([html, *(base64.b64decode(content).decode() for content in embedded)])
    letters = colours(texts, "text") | {"#000000"}
    sheets = colours(texts, "rect") | {"#ffffff"}
    return [
        f"{letter} on {sheet}: {ratio:.2f} {page}"
        for letter in letters
        for sheet in sheets
        for page, change in (("light", lambda colour: colour), ("dark", inverted))
        if (ratio := contrast(change(rgb(letter)), change(rgb(sheet)))) < 4.5
    ]


@pytest.mark.parametrize("colour", [plots.CURVE_COLOUR, plots.EVENT_COLOUR, plots.FEEDBACK_COLOUR])
def test_the_colours_of_plots_on_pages_stand_out(colour: str) -> None:
    assert (
        contrast(rgb(colour), rgb("#ffffff"))
        > 4.5
        < contrast(inverted(rgb(colour)), inverted(rgb("#ffffff")))
    )


def colours(svg: str, element: str) -> set[str]:
    """The colours with which elements of an SVG are filled."""
    tags = re.findall(rf"<{element}\b[^>]*>", svg)
    return {found for tag in tags for found in re.findall(r"fill[=:]\s*\"?(#[0-9a-fA-F]{6})", tag)}


def rgb(colour: str) -> np.ndarray:
    return np.array([int(colour[place : place + 2], 16) for place in (1, 3, 5)]) / 255


def inverted(colour: np.ndarray) -> np.ndarray:
    """The colour after the filter of dark pages (W3C, Filter Effects, 9.4 and 9.6)."""
    found = re.search(r"invert\(([\d.]+)\) hue-rotate\((\d+)deg\)", DARK_IN_JUPYTERLAB)
    assert found
    amount, cosine = float(found[1]), math.cos(math.radians(float(found[2])))
    weights = np.array([0.213, 0.715, 0.072])
    turn = weights + cosine * (np.eye(3) - weights)  # the sine of 180° is 0
    return np.clip(turn @ (amount + colour * (1 - 2 * amount)), 0.0, 1.0)


def contrast(one: np.ndarray, other: np.ndarray) -> float:
    """The contrast ratio of WCAG 2.1."""
    low, high = sorted(
        float(np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4) @ [0.2126, 0.7152, 0.0722])
        for c in (one, other)
    )
    return (high + 0.05) / (low + 0.05)
