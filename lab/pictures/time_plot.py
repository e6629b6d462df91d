"""Plots quantities over time: one panel for each, with labelled moments above the panels."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from IPython.display import HTML

from lab.pictures.figure import BLUE, BOTTOM, GREY, LEFT, TOP, VERMILION, annotate, as_html, sheet
from lab.pictures.labels import ROW, Mark, overhang, rows_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

WIDTH, HEIGHT, SPACE = 5.4, 1.6, 0.18  # inches, of a panel, and between two panels
MAX_STRETCH = (
    1.5  # of the first panel's range, so that a dashed curve fits in; one that needs more is cut off
)
MAX_DRAWN_POINTS = 40  # a curve of at most this many values also has points
TIME = "s since the recording began (system clock)"


class Curve(NamedTuple):
    """Values of a quantity (in `unit`) at the given times (s); its panel shows at least `min_range`."""

    name: str
    unit: str
    min_range: float
    times: np.ndarray
    values: np.ndarray


class Area(NamedTuple):
    """A period from `begin` to `end` (s) that is coloured in all panels."""

    name: str
    begin: float
    end: float


def draw_panels(
    curves: Sequence[Curve],
    *,
    seconds: float,
    marks: Sequence[Mark],
    changes: Sequence[Mark],
    compare: Mapping[str, Callable[[float], float]],
    areas: Sequence[Area],
    title: str,
) -> HTML:
    """Draw curves below each other over the same `seconds`, with `marks` (solid) and `changes` of the mode (dotted).

    `compare` has functions of the time, which are drawn dashed in the first panel; `areas` are coloured.
    """
    flags = sorted([*marks, *changes])
    scale = WIDTH / seconds
    rows = rows_of(flags, scale)
    band = ROW * (max(rows, default=-1) + 1)
    height = TOP + band + len(curves) * (HEIGHT + SPACE) + BOTTOM
    width = LEFT + WIDTH + max(0.25, overhang(flags, seconds, scale))
    with sheet(width, height, title) as page:
        panels: list[Axes] = []
        for index, curve in enumerate(curves):
            bottom = height - TOP - band - HEIGHT - index * (HEIGHT + SPACE)
            place = (LEFT / width, bottom / height, WIDTH / width, HEIGHT / height)
            panels.append(page.add_axes(place))
            _draw(panels[-1], curve, seconds)
        for name, function in compare.items():
            _draw_comparison(panels[0], name, function, seconds)
        for area in areas:
            _draw_area(panels, area)
        for mark, row in zip(flags, rows, strict=True):
            _draw_flag(panels, mark, band - row * ROW, is_change=mark in changes)
        for panel in panels[:-1]:
            panel.tick_params(labelbottom=False)
        panels[-1].set_xlabel(TIME)
        return as_html(page, _in_words(title, curves, seconds, flags, compare, areas))


def _draw(panel: Axes, curve: Curve, seconds: float) -> None:
    panel.axhline(0, color=GREY, linewidth=0.8)
    panel.plot(
        curve.times,
        curve.values,
        ".-" if len(curve.times) <= MAX_DRAWN_POINTS else "-",
        color=BLUE,
        linewidth=1.5,
        label="the robot",
    )
    panel.set_xlim(0, seconds)
    low, high = panel.get_ylim()
    missing = max(0.0, curve.min_range - (high - low)) / 2
    panel.set_ylim(low - missing, high + missing)
    panel.set_ylabel(f"{curve.name}, {curve.unit}")


def _draw_comparison(panel: Axes, name: str, function: Callable[[float], float], seconds: float) -> None:
    """Draw a function; it stretches the range of the robot's curve by at most MAX_STRETCH."""
    low, high = panel.get_ylim()
    times = np.linspace(0.0, seconds, 1000)
    values = np.array([float(function(at)) for at in times])
    panel.plot(times, values, "--", color=VERMILION, linewidth=1.5, label=name)
    margin = 0.05 * (high - low)
    lower, upper = min(low, np.nanmin(values) - margin), max(high, np.nanmax(values) + margin)
    panel.set_ylim((lower, upper) if upper - lower <= MAX_STRETCH * (high - low) else (low, high))
    panel.legend(loc="best", frameon=False)


def _draw_area(panels: Sequence[Axes], area: Area) -> None:
    for panel in panels:
        panel.axvspan(area.begin, area.end, color=VERMILION, alpha=0.25, linewidth=0)
    panels[0].text(
        (area.begin + area.end) / 2,
        0.97,
        _in_numbers(area),
        transform=panels[0].get_xaxis_transform(),
        ha="center",
        va="top",
        color="#803300",
        fontweight="bold",
    )


def _in_numbers(area: Area) -> str:
    return f"{area.name}: {area.end - area.begin:.2f} s"


def _draw_flag(panels: Sequence[Axes], mark: Mark, above: float, *, is_change: bool) -> None:
    """Draw a vertical line through all panels up to its label, whose top is `above` inches above the panels."""
    colour, line = (VERMILION, ":") if is_change else (GREY, "-")
    for panel in panels:
        panel.axvline(mark.time, color=colour, linestyle=line, linewidth=1.1)
    first, up = panels[0], [1, 1 + (above - 0.03) / HEIGHT]
    onto = first.get_xaxis_transform()
    first.plot([mark.time] * 2, up, color=colour, linestyle=line, lw=1.1, transform=onto, clip_on=False)
    place = {"xycoords": ("data", "axes fraction"), "va": "top"}
    text_colour = "#803300" if is_change else "black"
    annotate(first, mark.label, (mark.time, 1), (3, 72 * above - 2), color=text_colour, **place)


def _in_words(
    title: str,
    curves: Sequence[Curve],
    seconds: float,
    flags: Sequence[Mark],
    compare: Mapping[str, object],
    areas: Sequence[Area],
) -> str:
    def sentence(curve: Curve) -> str:
        lowest, highest = curve.values.argmin(), curve.values.argmax()
        return (
            f"{curve.name} in {curve.unit}: {curve.values[0]:.2f} at first, {curve.values[-1]:.2f} at last, "
            f"lowest {curve.values[lowest]:.2f} at {curve.times[lowest]:.2f} s, "
            f"highest {curve.values[highest]:.2f} at {curve.times[highest]:.2f} s."
        )

    compared = [f"Dashed beside {curves[0].name}: {', '.join(compare)}."] if compare else []
    coloured = [f"Coloured, {_in_numbers(area)} from {area.begin:.2f} s on." for area in areas]
    moments = [f"{mark.time:.2f} s: {mark.label}." for mark in flags]
    return " ".join(
        [f"{title}, {seconds:.1f} s.", *[sentence(curve) for curve in curves], *compared, *coloured, *moments]
    )
