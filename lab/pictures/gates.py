"""Draws what a callback waits for at any moment of a run: a free callback group, and then a free thread."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import ipywidgets
import numpy as np
from IPython.display import HTML

from lab.errors import LabError
from lab.pictures.figure import BLUE, GREY, VERMILION
from lab.pictures.slider import slide
from lab.pictures.thread_plot import NO_THREAD, Span, plot_spans, read_steps, spans_of
from lab.running.student_nodes import StudentNode
from ros_runtime.drawing.svg import escape, svg

WIDTH, ROW, ABOVE = 586, 56, 58  # px
NAME_X, GROUP_X, THREAD_X, RUNS_X = 12, 116, 354, 522  # px, where the parts of a row begin
MOMENTS = 41  # on the slider
FREE_COLOUR = "#007A5E"


def draw_gates(
    node: StudentNode, groups: Mapping[str, str], *, threads: int, title: str = "The two gates"
) -> ipywidgets.VBox:
    """Draw the threads of a node like `draw_threads`, with a slider that shows both gates at a moment of the run.

        lab.draw_gates(node, {"beat": "default group", "look_around": "default group"}, threads=4)

    A callback passes two gates before it runs: its group and a thread must be free. `groups` maps each callback to its
    mutually exclusive group. The slider begins in the middle of the longest callback.

    Raises LabError when the node has printed no line for `draw_threads`, or one of a callback that is not in `groups`.
    """
    steps = read_steps(node.log())
    missing = sorted({step.callback for step in steps} - groups.keys())
    if not steps or missing:
        raise LabError(
            f"{node.file.name}: "
            + (
                f"`groups` has no group for {', '.join(missing)}"
                if steps
                else "the node has printed no lines about its callbacks; let it run for a moment"
            )
        )
    zero = steps[0].time
    spans = [
        Span(span.lane, span.callback, span.begin - zero, span.end - zero, span.is_over)
        for span in spans_of(steps, max(steps[-1].time, node.history().ended or time.monotonic()))
    ]
    longest = max(spans, key=lambda span: span.end - span.begin)
    moments = np.linspace(0.0, max(span.end for span in spans), MOMENTS)
    start = moments[np.argmin(abs(moments - (longest.begin + longest.end) / 2))]

    def at(moment: float) -> HTML:
        gates = _Gates(spans, groups, threads, moment)
        return HTML(plot_spans(spans, title=title, cursor=moment).data + gates.svg())

    return slide(
        "moment, s", [round(float(moment), 2) for moment in moments], at, start=round(float(start), 2)
    )


@dataclass(frozen=True)
class _Gates:
    """The gates at a moment (s) of a run."""

    spans: Sequence[Span]
    groups: Mapping[str, str]
    threads: int
    moment: float

    def inside(self, group: str) -> str | None:
        """Return the callback that occupies a group because it runs or awaits; None if the group is free."""
        now = (span.callback for span in self._now() if self.groups[span.callback] == group)
        return next(now, None)

    @property
    def free_threads(self) -> int:
        return self.threads - sum(span.lane != NO_THREAD for span in self._now())

    def _now(self) -> list[Span]:
        return [span for span in self.spans if span.begin <= self.moment <= span.end]

    def svg(self) -> str:
        names = list(self.groups)
        words: list[str] = []
        parts = [
            f'<text x="{x}" y="48" font-size="12" fill="{GREY}">{gate}</text>'
            for x, gate in ((GROUP_X, "first gate: its group"), (THREAD_X, "second gate: a thread"))
        ]
        for row, name in enumerate(names):
            drawn, sentence = self._row(name, ABOVE + row * ROW)
            parts += drawn
            words.append(sentence)
        title = f"The gates at {self.moment:.2f} s"
        height = ABOVE + ROW * len(names) + 8
        return svg(parts, width=WIDTH, height=height, title=title, words=" ".join(words))

    def _row(self, name: str, y: float) -> tuple[list[str], str]:
        group = self.groups[name]
        keeper, free = self.inside(group), self.free_threads
        held = [span.lane for span in self._now() if span.callback == name]
        if held:
            place = "awaits, on no thread" if held[-1] == NO_THREAD else "runs"
            shown = [
                *_name(name, y),
                _pill(GROUP_X, y, 398, f"{place}; it keeps its group, the {group}", BLUE),
            ]
            return shown, f"{name} {place} and keeps the {group}."
        first = f"{group}: {keeper} is in" if keeper else f"{group}: free"
        second = f"{max(free, 0)} of {self.threads} threads free"
        is_open = keeper is None and free > 0
        return [
            *_name(name, y),
            _pill(GROUP_X, y, 230, first, VERMILION if keeper else FREE_COLOUR),
            _pill(THREAD_X, y, 160, second, FREE_COLOUR if free > 0 else VERMILION),
            f'<text x="{RUNS_X}" y="{y + 25}" font-weight="bold">{"may run" if is_open else "waits"}</text>',
        ], f"{name}, if it is due, {'may run' if is_open else 'waits'}: {first}, {second}."


def _name(name: str, y: float) -> list[str]:
    return [f'<text x="{NAME_X}" y="{y + 25}">{escape(name)}</text>']


def _pill(x: float, y: float, width: float, text: str, colour: str) -> str:
    return (
        f'<rect x="{x}" y="{y}" width="{width}" height="40" rx="8" fill="white" stroke="{colour}" stroke-width="2.5"/>'
        f'<text x="{x + 12}" y="{y + 25}" fill="{colour}">{escape(text)}</text>'
    )
