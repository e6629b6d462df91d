"""Plots values that a notebook has computed: curves in one panel, and the means of recordings."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from IPython.display import HTML
from numpy.typing import ArrayLike

from lab.errors import LabError
from lab.pictures.figure import BLUE, GREY, VERMILION, annotate, as_html, panel
from lab.pictures.labels import text_width
from lab.pictures.quantities import quantity_named
from lab.pictures.recording import Recording

MEANS_WIDTH = 5.0  # inches
STYLES = (("-", BLUE), ("--", VERMILION), (":", GREY))


def plot_curves(
    curves: Mapping[str, tuple[ArrayLike, ArrayLike]],
    x: str,
    y: str,
    *,
    title: str = "Curves",
    factor: float | None = None,
) -> HTML:
    """Draw up to three curves; `curves` maps each name to its values on the x axis and on the y axis.

        times, metres = recording.values("x")
        lab.plot_curves({"straight ahead": (times, metres)}, "time, s", "x, m")

    With a `factor`, a grey band shows which values differ from the last curve by at most this factor. Then all curves
    need the same values on the x axis.

    Raises LabError when there is no curve or more than three, or when a curve has no points or lists of unequal length.
    """
    if not 1 <= len(curves) <= len(STYLES):
        raise LabError(f"there are {len(curves)} curves; plot_curves draws one to {len(STYLES)}")
    lines = {name: (np.asarray(xs, float), np.asarray(ys, float)) for name, (xs, ys) in curves.items()}
    words = [f"{title}."]
    with panel(5.4, 3.0, title) as (page, axes):
        for (name, (xs, ys)), (line, colour) in zip(lines.items(), STYLES, strict=False):
            if not len(xs) or xs.shape != ys.shape:
                raise LabError(
                    f"{name} has {len(xs)} values for {x} and {len(ys)} for {y}; both need equally many, at least one"
                )
            axes.plot(xs, ys, line, color=colour, linewidth=1.6, label=name)
            words += [
                f"{name}: {y} from {ys[0]:.2f} at {x} {xs[0]:.2f} to {ys[-1]:.2f} at {xs[-1]:.2f},",
                f"lowest {np.nanmin(ys):.2f}, highest {np.nanmax(ys):.2f}.",
            ]
        if factor is not None:
            *others, (_, (xs, truth)) = lines.items()
            low, high = truth / factor, truth * factor
            axes.fill_between(xs, low, high, color="#dddddd", label=f"within a factor of {factor:g}")
            words += [f"{name}: {_stay(xs, (low <= ys) & (ys <= high))}." for name, (_, ys) in others]
        axes.set_xlabel(x)
        axes.set_ylabel(y)
        axes.legend(loc="best", frameon=False)
        return as_html(page, " ".join(words))


def _stay(xs: np.ndarray, is_inside: np.ndarray) -> str:
    """Describe the longest range of x in which the values are inside the band."""
    ends = np.flatnonzero(np.diff([False, *is_inside, False]))
    stays = [(xs[begin], xs[end - 1]) for begin, end in zip(ends[::2], ends[1::2], strict=True)]
    if not stays:
        return "never inside the band"
    begin, end = max(stays, key=lambda stay: stay[1] - stay[0])
    return f"inside the band from {begin:.2f} to {end:.2f}"


def plot_means(recordings: Mapping[str, Recording], x: str, y: str, *, title: str = "Means") -> HTML:
    """Draw a point for each recording, at the means of two quantities; `recordings` maps names to recordings.

        lab.plot_means({"standing": first, "0.3 m/s": second}, "speed", "power")

    Raises LabError when there is no recording or no such quantity, or when no value of the quantity was recorded.
    """
    if not recordings:
        raise LabError("there is no recording to plot: make recordings with lab.record_robot() first")
    points = {name: (recording.mean(x), recording.mean(y)) for name, recording in recordings.items()}
    across, up = (f"mean {name}, {quantity_named(name).unit}" for name in (x, y))
    with panel(MEANS_WIDTH, 3.0, title) as (page, axes):
        axes.plot(*zip(*points.values(), strict=True), "o", color=BLUE, markersize=6.5)
        for name, point in points.items():
            annotate(axes, name, point, (8, -3))
        left, right = axes.get_xlim()
        share = (max(map(text_width, points)) + 0.15) / MEANS_WIDTH  # of a name beside the last point
        axes.set_xlim(left, right + (right - left) * share / (1 - share))
        axes.set_xlabel(across)
        axes.set_ylabel(up)
        axes.set_ylim(bottom=min(0.0, axes.get_ylim()[0]))
        sentences = [f"{name}: {across} {a:.2f}, {up} {b:.2f}." for name, (a, b) in points.items()]
        return as_html(page, " ".join([f"{title}.", *sentences]))
