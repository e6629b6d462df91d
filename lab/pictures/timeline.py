"""Draws processes on one time axis, each with the lines that it has printed."""

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
from lab.running.processes import ProcessHistory
from lab.running.programs import Program
from lab.running.student_nodes import StudentNode
from ros_runtime.drawing.svg import shorten

if TYPE_CHECKING:
    from matplotlib.axes import Axes

WIDTH = 6.6  # inches, the length of the time axis
BAR, SPACE = 0.16, 0.16  # inches, the height of a process's bar, and of the space below it
LABEL_LENGTH = 48  # characters
MAX_BURST_GAP = 0.05  # s between two lines of one burst; a long burst is shortened
TIME = "s since the first process began (system clock)"


def draw_timeline(*processes: StudentNode | Program, title: str = "Who did what when") -> HTML:
    """Draw nodes and programs as bars from their start to their end, each with the lines that it has printed.

    The time of a line is when the notebook received it, a few milliseconds after it was printed. If many lines arrive
    at once, only the first and the last one are shown.

    Raises LabError when no process is given.
    """
    if not processes:
        raise LabError("name the processes to draw, for example lab.draw_timeline(server, client)")
    histories = _with_unique_names([process.history() for process in processes])
    zero, now = min(history.began for history in histories), time.monotonic()
    end = max(history.ended or now for history in histories) - zero
    scale = WIDTH / end
    moments = [_flags(history, zero) for history in histories]
    lanes = [[Mark(mark.time, shorten(mark.label, LABEL_LENGTH)) for mark in lane] for lane in moments]
    rows = [rows_of(flags, scale) for flags in lanes]
    left = 0.3 + max(text_width(history.name) for history in histories)
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
        for history, flags, lane_rows, depth in zip(histories, lanes, rows, depths, strict=True):
            bar = top + depth - SPACE - BAR
            _draw_process(axis, history, zero, now, bar)
            for mark, row in zip(flags, lane_rows, strict=True):
                _draw_line(axis, mark, top + row * ROW, bar, is_end=mark is flags[-1] and bool(history.ended))
            top += depth
        return as_html(page, _in_words(title, histories, moments, zero))


def _with_unique_names(histories: Sequence[ProcessHistory]) -> list[ProcessHistory]:
    """Return the histories, with a number appended to each name that occurs more than once."""
    counts, seen = Counter(history.name for history in histories), Counter[str]()
    named = []
    for history in histories:
        seen[history.name] += 1
        number = f" ({seen[history.name]})" if counts[history.name] > 1 else ""
        named.append(replace(history, name=history.name + number))
    return named


def _flags(history: ProcessHistory, zero: float) -> list[Mark]:
    """Return the labels of a process: its printed lines and its end."""
    bursts: list[list[Mark]] = []
    for line in history.lines:
        if bursts and line.time - bursts[-1][-1].time < MAX_BURST_GAP:
            bursts[-1].append(line)
        else:
            bursts.append([line])
    shown: list[Mark] = []
    for burst in bursts:
        if len(burst) > 3:
            between = Mark(burst[1].time, f"… {len(burst) - 2} more lines …")
            burst = [burst[0], between, burst[-1]]
        shown += burst
    ending = [] if history.ended is None else [Mark(history.ended, history.end)]
    return [Mark(mark.time - zero, mark.label) for mark in [*shown, *ending]]


def _draw_process(axis: Axes, history: ProcessHistory, zero: float, now: float, bar: float) -> None:
    until = (now if history.ended is None else history.ended) - zero
    axis.broken_barh(
        [(history.began - zero, until - history.began + zero)],
        (bar, BAR),
        facecolor="#cfe3f1",
        edgecolor=BLUE,
    )
    beside = {"xycoords": ("axes fraction", "data"), "ha": "right", "va": "center"}
    annotate(axis, history.name, (0, bar + BAR / 2), (-6, 0), **beside)


def _draw_line(axis: Axes, mark: Mark, label_top: float, bar: float, *, is_end: bool) -> None:
    line = [label_top + 0.02, bar + BAR]
    axis.plot([mark.time] * 2, line, color=VERMILION if is_end else GREY, linewidth=1.1, clip_on=False)
    colour = "#803300" if is_end else "black"
    annotate(axis, mark.label, (mark.time, label_top), (3, -2), va="top", color=colour)


def _in_words(
    title: str, histories: Sequence[ProcessHistory], lanes: Sequence[Sequence[Mark]], zero: float
) -> str:
    def sentence(history: ProcessHistory, flags: Sequence[Mark]) -> str:
        lines = "; ".join(f"{mark.time:.2f} s: {mark.label}" for mark in flags)
        runs = " It still runs." if history.ended is None else ""
        return f"{history.name} began at {history.began - zero:.2f} s; {lines or 'it printed nothing'}.{runs}"

    return " ".join(
        [f"{title}.", *(sentence(history, flags) for history, flags in zip(histories, lanes, strict=True))]
    )
