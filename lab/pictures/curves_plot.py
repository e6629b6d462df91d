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

    With a `factor`, a band shows where the last curve is missed by no more than that factor, and the legend how much of
    each other curve is inside; they need the same values along x.

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
            *others, truth = lines.values()
            shares = [_inside(ys, truth[1], factor) for _, ys in others]
            names = [f"{name}: {share:.0%} inside" for name, share in zip(lines, shares, strict=False)]
            lines = dict(zip([*names, *[*lines][-1:]], lines.values(), strict=True))
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
        return as_html(
            page, " ".join([f"{title}.", *(_in_words(name, *line, x, y) for name, line in lines.items())])
        )


def _inside(values: np.ndarray, truth: np.ndarray, factor: float) -> float:
    """The share of the values that miss the truth by no more than a factor."""
    return float(np.mean((values >= truth / factor) & (values <= truth * factor)))


def _in_words(name: str, xs: np.ndarray, ys: np.ndarray, x: str, y: str) -> str:
    return (
        f"{name}: {y} from {ys[0]:.2f} at {x} {xs[0]:.2f} to {ys[-1]:.2f} at {xs[-1]:.2f}, "
        f"lowest {np.nanmin(ys):.2f}, highest {np.nanmax(ys):.2f}."
    )
