"""Curves that a notebook has computed, in one panel."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from IPython.display import HTML
from numpy.typing import ArrayLike

from lab.errors import LabError
from lab.pictures.figure import BLUE, BOTTOM, GREY, LEFT, TOP, VERMILION, as_html, sheet

WIDTH, HEIGHT = 6.6, 3.0  # inches
STYLES = (("-", BLUE), ("--", VERMILION), (":", GREY))


def plot_curves(
    curves: Mapping[str, tuple[ArrayLike, ArrayLike]],
    x: str,
    y: str,
    *,
    title: str = "Curves",
    factor: float | None = None,
) -> HTML:
    """Draw up to three curves, each from its values along the x and the y axis; `curves` maps names to both.

        times, metres = recording.values("x")
        lab.plot_curves({"straight ahead": (times, metres)}, "time, s", "x, m")

    With a `factor`, a band shows where the last curve is missed by no more than that factor; then all curves need the
    same values along x.

    Raises LabError when there is no curve or more than three, or one has no points or lists of unequal length.
    """
    if not 1 <= len(curves) <= len(STYLES):
        raise LabError(f"{len(curves)} curves; plot_curves draws one to {len(STYLES)} in a panel")
    lines = {name: (np.asarray(xs, float), np.asarray(ys, float)) for name, (xs, ys) in curves.items()}
    for name, (xs, ys) in lines.items():
        if not len(xs) or xs.shape != ys.shape:
            raise LabError(
                f"{name}: {len(xs)} values for {x} and {len(ys)} for {y}; both need the same, at least one"
            )
    width, height = LEFT + WIDTH + 0.25, TOP + HEIGHT + BOTTOM
    with sheet(width, height, title) as page:
        panel = page.add_axes((LEFT / width, BOTTOM / height, WIDTH / width, HEIGHT / height))
        if factor is not None:
            truth = [*lines.values()][-1]
            panel.fill_between(
                truth[0],
                truth[1] / factor,
                truth[1] * factor,
                color="#dddddd",
                label=f"within a factor of {factor:g}",
            )
        for (name, (xs, ys)), (line, colour) in zip(lines.items(), STYLES, strict=False):
            panel.plot(xs, ys, line, color=colour, linewidth=1.6, label=name)
        panel.set_xlabel(x)
        panel.set_ylabel(y)
        panel.legend(loc="best", frameon=False)
        told = [f"{title}.", *(_in_words(name, *line, x, y) for name, line in lines.items())]
        if factor is not None:
            told += [
                f"{name}: {_stay(xs, (ys >= truth[1] / factor) & (ys <= truth[1] * factor))}."
                for name, (xs, ys) in [*lines.items()][:-1]
            ]
        return as_html(page, " ".join(told))


def _stay(xs: np.ndarray, is_inside: np.ndarray) -> str:
    """From where to where values stay inside the band, the longest time that they do."""
    ends = np.flatnonzero(np.diff([False, *is_inside, False]))
    stays = [(xs[begin], xs[end - 1]) for begin, end in zip(ends[::2], ends[1::2], strict=True)]
    if not stays:
        return "never inside the band"
    begin, end = max(stays, key=lambda stay: stay[1] - stay[0])
    return f"inside the band from {begin:.2f} to {end:.2f}"


def _in_words(name: str, xs: np.ndarray, ys: np.ndarray, x: str, y: str) -> str:
    return (
        f"{name}: {y} from {ys[0]:.2f} at {x} {xs[0]:.2f} to {ys[-1]:.2f} at {xs[-1]:.2f}, "
        f"lowest {np.nanmin(ys):.2f}, highest {np.nanmax(ys):.2f}."
    )
