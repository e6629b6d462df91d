"""Processes on one time axis, each with the lines that it printed."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from IPython.display import HTML

from lab.errors import LabError
from lab.pictures.figure import BLUE, GREY, VERMILION, annotate, as_html, panel
from lab.pictures.labels import ROW, Mark, overhang, rows_of, text_width
from lab.running.processes import Life
from lab.running.programs import Program
from lab.running.student_nodes import StudentNode
from ros_runtime.drawing.xml_text import shorten

if TYPE_CHECKING:
    from matplotlib.axes import Axes

WIDTH = 6.6  # inches, of the time axis
BAR, SPACE = 0.16, 0.16  # inches: height of a process, and below it
LABEL_LENGTH = 48  # characters
BURST_GAP = 0.05  # s, at most, between two lines of one burst; a long burst is shortened
TIME = "s since the first of them began (system clock)"


def draw_timeline(*processes: StudentNode | Program, title: str = "Who did what when") -> HTML:
    """Draw nodes and programs as bars from their beginning to their end, each with the lines it printed.

    A line has the time at which the notebook received it, some milliseconds after it was printed. Of a burst of lines
    the first and the last are shown.

    Raises LabError when no process is given.
    """
    if not processes:
        raise LabError("say which processes to draw, for example lab.draw_timeline(server, client)")
    lives = _told_apart([process.life() for process in processes])
    zero, now = min(life.began for life in lives), time.monotonic()
    end = max(life.ended or now for life in lives) - zero
    scale = WIDTH / end
    moments = [_flags(life, zero) for life in lives]
    lanes = [[Mark(mark.time, shorten(mark.label, LABEL_LENGTH)) for mark in lane] for lane in moments]
    rows = [rows_of(flags, scale) for flags in lanes]
    left = 0.3 + max(text_width(life.name) for life in lives)
    right = max(0.25, *(overhang(flags, end, scale) for flags in lanes))
    depths = [ROW * (max(rows_of_lane, default=-1) + 1) + BAR + SPACE for rows_of_lane in rows]
    with panel(WIDTH, sum(depths), title, left=left, right=right) as (page, axis):
        axis.set_xlim(0, end)
        axis.set_ylim(sum(depths), 0)  # inches, downwards
        axis.grid(axis="y", visible=False)
        axis.set_yticks([])
        axis.spines["left"].set_visible(False)
        axis.set_xlabel(TIME)
        top = 0.0
        for life, flags, lane_rows, depth in zip(lives, lanes, rows, depths, strict=True):
            bar = top + depth - SPACE - BAR
            _draw_life(axis, life, zero, now, bar)
            for mark, row in zip(flags, lane_rows, strict=True):
                _draw_line(axis, mark, top + row * ROW, bar, is_end=mark is flags[-1] and bool(life.ended))
            top += depth
        return as_html(page, _in_words(title, lives, moments, zero))


def _told_apart(lives: Sequence[Life]) -> list[Life]:
    """The lives, with numbers appended to names that occur more than once."""
    counts, seen = Counter(life.name for life in lives), Counter[str]()
    named = []
    for life in lives:
        seen[life.name] += 1
        number = f" ({seen[life.name]})" if counts[life.name] > 1 else ""
        named.append(replace(life, name=life.name + number))
    return named


def _flags(life: Life, zero: float) -> list[Mark]:
    """The labels of a life: its printed lines and its end."""
    bursts: list[list[Mark]] = []
    for line in life.lines:
        if bursts and line.time - bursts[-1][-1].time < BURST_GAP:
            bursts[-1].append(line)
        else:
            bursts.append([line])
    shown: list[Mark] = []
    for burst in bursts:
        if len(burst) > 3:
            between = Mark(burst[1].time, f"… {len(burst) - 2} more lines …")
            burst = [burst[0], between, burst[-1]]
        shown += burst
    ending = [] if life.ended is None else [Mark(life.ended, life.end)]
    return [Mark(mark.time - zero, mark.label) for mark in [*shown, *ending]]


def _draw_life(axis: Axes, life: Life, zero: float, now: float, bar: float) -> None:
    until = (now if life.ended is None else life.ended) - zero
    axis.broken_barh(
        [(life.began - zero, until - life.began + zero)], (bar, BAR), facecolor="#cfe3f1", edgecolor=BLUE
    )
    beside = {"xycoords": ("axes fraction", "data"), "ha": "right", "va": "center"}
    annotate(axis, life.name, (0, bar + BAR / 2), (-6, 0), **beside)


def _draw_line(axis: Axes, mark: Mark, label_top: float, bar: float, *, is_end: bool) -> None:
    line = [label_top + 0.02, bar + BAR]
    axis.plot([mark.time] * 2, line, color=VERMILION if is_end else GREY, linewidth=1.1, clip_on=False)
    colour = "#803300" if is_end else "black"
    annotate(axis, mark.label, (mark.time, label_top), (3, -2), va="top", color=colour)


def _in_words(title: str, lives: Sequence[Life], lanes: Sequence[Sequence[Mark]], zero: float) -> str:
    def sentence(life: Life, flags: Sequence[Mark]) -> str:
        lines = "; ".join(f"{mark.time:.2f} s: {mark.label}" for mark in flags)
        runs = " It still runs." if life.ended is None else ""
        return f"{life.name} began at {life.began - zero:.2f} s; {lines or 'it printed nothing'}.{runs}"

    return " ".join([f"{title}.", *(sentence(life, flags) for life, flags in zip(lives, lanes, strict=True))])
