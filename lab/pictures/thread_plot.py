"""Draws which callback ran on which thread and when, from the lines that a program has printed."""

from __future__ import annotations

import re
import time
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

from IPython.display import HTML

from lab.errors import LabError
from lab.pictures.figure import BLUE, GREY, VERMILION, as_html, panel
from lab.pictures.labels import text_width
from lab.running.student_nodes import StudentNode

if TYPE_CHECKING:
    from matplotlib.axes import Axes

WIDTH, LANE = 6.6, 0.42  # inches, the length of the time axis, and the height of a thread's lane
LEGEND = 0.25  # inches, the height of the legend above the lanes
NO_THREAD = "awaiting, on no thread"
COLOURS = (BLUE, VERMILION, "#007A5E", "#8A4F7D", GREY)
TIME = "s since the first line (system clock)"
_LINE = re.compile(
    r"^(?P<time>\d+\.\d+) (?P<thread>\S+) (?P<callback>\S+) (?P<verb>begins|awaits|resumes|ends)$",
    re.MULTILINE,
)


class Step(NamedTuple):
    """A line that the program has printed: at `time` (s) a callback begins, awaits, resumes or ends on a thread."""

    time: float
    thread: str
    callback: str
    verb: str


@dataclass(frozen=True)
class Span:
    """A part of a callback, from `begin` to `end` (s); its lane is its thread or, while it awaits, `NO_THREAD`."""

    lane: str
    callback: str
    begin: float
    end: float
    is_over: bool = True


def draw_threads(node: StudentNode, *, title: str = "Which callback ran on which thread") -> HTML:
    """Draw a lane for each thread of a node, with the callbacks that ran on it.

    The program must print a line for each step of a callback: the time in s of `time.monotonic()`, the thread's name,
    the callback's name and a verb.

        1234.5678 MainThread beat begins

    The verbs are "begins" and "ends", and for a coroutine also "awaits" and "resumes". A callback that awaits occupies
    no thread, so it is drawn on a lane of its own. A callback without an end is drawn until the node ended, or until
    now.

    Raises LabError when the node has printed no such line.
    """
    steps = read_steps(node.log())
    if not steps:
        raise LabError(
            f"{node.file.name} has printed no line like “1234.5678 MainThread beat begins”: call trace() or use "
            "traced() in the node's callbacks, and let the node run for a moment"
        )
    return plot_spans(
        spans_of(steps, max(steps[-1].time, node.history().ended or time.monotonic())), title=title
    )


def plot_spans(spans: Sequence[Span], *, title: str, cursor: float | None = None) -> HTML:
    """Draw spans on the lanes of their threads, with a vertical line at `cursor`, in s since the first span began."""
    zero, last = min(span.begin for span in spans), max(span.end for span in spans)
    lanes = _lanes(spans)
    colours = dict(zip(dict.fromkeys(span.callback for span in spans), COLOURS * 9, strict=False))
    left = 0.3 + max(text_width(lane) for lane in lanes)
    with panel(WIDTH, LANE * len(lanes), title, left=left, above=LEGEND) as (page, axis):
        axis.set_xlim(0, max(last - zero, 0.1))
        axis.set_ylim(len(lanes), 0)
        axis.set_yticks([row + 0.5 for row in range(len(lanes))], lanes)
        axis.tick_params(axis="y", length=0)
        axis.grid(axis="y", visible=False)
        axis.set_axisbelow(True)
        axis.set_xlabel(TIME)
        for span in spans:
            _draw(axis, span, lanes.index(span.lane), zero, colours[span.callback])
        for row in range(1, len(lanes)):
            axis.axhline(row, color="#e6e6e6", linewidth=0.8)
        if cursor is not None:
            axis.axvline(cursor, color="black", linewidth=2)
        _draw_legend(axis, colours)
        return as_html(page, _in_words(title, spans, lanes, zero))


def read_steps(log: str) -> list[Step]:
    """Return the steps in a program's output, in order of time; other lines are ignored."""
    found = (Step(float(line[1]), line[2], line[3], line[4]) for line in _LINE.finditer(log))
    return sorted(found, key=lambda step: step.time)


def spans_of(steps: Iterable[Step], until: float) -> list[Span]:
    """Combine steps into spans; a span without an end ends at `until`.

    A coroutine may resume on another thread, so "awaits" and "resumes" are matched by the callback's name only.
    """
    spans: list[Span] = []
    running: dict[tuple[str, str], float] = {}
    awaiting: dict[str, list[float]] = {}
    for step in steps:
        key = (step.thread, step.callback)
        if step.verb == "resumes" and awaiting.get(step.callback):
            begin = awaiting[step.callback].pop(0)
            spans.append(Span(NO_THREAD, step.callback, begin, step.time))
        if step.verb in ("awaits", "ends") and key in running:
            spans.append(Span(step.thread, step.callback, running.pop(key), step.time))
        if step.verb == "awaits":
            awaiting.setdefault(step.callback, []).append(step.time)
        if step.verb in ("begins", "resumes"):
            running[key] = step.time
    spans += [Span(thread, name, begin, until, is_over=False) for (thread, name), begin in running.items()]
    spans += [
        Span(NO_THREAD, name, begin, until, is_over=False)
        for name, begins in awaiting.items()
        for begin in begins
    ]
    return sorted(spans, key=lambda span: span.begin)


def _lanes(spans: Sequence[Span]) -> list[str]:
    threads = sorted({span.lane for span in spans} - {NO_THREAD})
    return [*threads, NO_THREAD] if any(span.lane == NO_THREAD for span in spans) else threads


def _draw(axis: Axes, span: Span, row: int, zero: float, colour: str) -> None:
    is_held = span.lane != NO_THREAD
    axis.broken_barh(
        [(span.begin - zero, span.end - span.begin)],
        (row + 0.15, 0.7),
        facecolor=colour if is_held else "white",
        edgecolor=colour,
        linewidth=1.2,
        linestyle="-" if is_held else "--",
    )


def _draw_legend(axis: Axes, colours: dict[str, str]) -> None:
    from matplotlib.patches import Patch

    axis.legend(
        handles=[Patch(color=colour, label=name) for name, colour in colours.items()],
        loc="lower left",
        bbox_to_anchor=(0, 1),
        ncols=len(colours),
        frameon=False,
        borderaxespad=0.1,
    )


def _in_words(title: str, spans: Sequence[Span], lanes: Sequence[str], zero: float) -> str:
    sentences = [f"{title}."]
    for lane in lanes:
        here = [span for span in spans if span.lane == lane]
        sentences.append(f"{lane}: " + "; ".join(_several(name, here, zero) for name in _names(here)) + ".")
    for name in _names(spans):
        begins = [span.begin for span in spans if span.callback == name and span.lane != NO_THREAD]
        if len(begins) > 2:
            longest = max(later - earlier for earlier, later in pairwise(begins))
            sentences.append(f"Longest time from one {name} to the next: {longest:.2f} s.")
    return " ".join(sentences)


def _names(spans: Iterable[Span]) -> list[str]:
    return list(dict.fromkeys(span.callback for span in spans))


def _several(name: str, spans: Sequence[Span], zero: float) -> str:
    mine = [span for span in spans if span.callback == name]
    if len(mine) > 2:
        return f"{name} {len(mine)} times"
    return ", ".join(
        f"{name} from {span.begin - zero:.2f} s "
        + (f"to {span.end - zero:.2f} s" if span.is_over else "on, without an end")
        for span in mine
    )
