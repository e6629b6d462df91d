"""The figure that plots are drawn on: white, with the same fonts and colours in all plots."""

from __future__ import annotations

import io
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from IPython.display import HTML

from lab.pictures.labels import FONT_SIZE
from lab.pictures.picture import figure

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PIXELS_PER_INCH = 96
LEFT, TOP, BOTTOM = 0.85, 0.42, 0.5  # inches: y labels, title, x axis
# From the palette of Okabe and Ito, safe for colour-blind readers; no text in a figure relies on colours.
BLUE: str = "#0072B2"
VERMILION: str = "#B34700"
GREY: str = "#555555"

_STYLE = {
    "font.size": FONT_SIZE,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "#e6e6e6",
    "svg.fonttype": "none",  # keep text as text, not as paths: it can be searched, copied and enlarged
}


@contextmanager
def sheet(width: float, height: float, title: str) -> Iterator[Figure]:
    """A figure of so many inches with a title, in the style of the lab."""
    import matplotlib
    from matplotlib.figure import Figure  # takes a while to import, and most notebooks draw nothing

    with matplotlib.rc_context(_STYLE):
        page = Figure((width, height), facecolor="white")
        page.text(0.12 / width, 1 - 0.1 / height, title, va="top", fontsize=FONT_SIZE + 2, fontweight="bold")
        yield page


@contextmanager
def panel(
    width: float, height: float, title: str, *, left: float = LEFT, right: float = 0.25, above: float = 0.0
) -> Iterator[tuple[Figure, Axes]]:
    """A figure with one panel of so many inches; `left`, `right`, `above`: inches around it, for texts."""
    whole_width, whole_height = left + width + right, TOP + above + height + BOTTOM
    with sheet(whole_width, whole_height, title) as page:
        yield (
            page,
            page.add_axes(
                (left / whole_width, BOTTOM / whole_height, width / whole_width, height / whole_height)
            ),
        )


def annotate(
    axes: Axes, text: str, at: tuple[float, float], offset: tuple[float, float], **more: Any
) -> None:
    """Write a text `offset` points beside a place, also outside of the panel; in it, $ and _ are no mathematics."""
    axes.annotate(
        text,
        at,
        xytext=offset,
        textcoords="offset points",
        annotation_clip=False,
        parse_math=False,
        **more,
    )


def as_html(page: Figure, words: str) -> HTML:
    """Embed a figure as SVG with an alternative text."""
    drawn = io.BytesIO()
    page.savefig(drawn, format="svg", metadata={"Date": None})
    width = round(page.get_figwidth() * PIXELS_PER_INCH)
    return figure(drawn.getvalue(), "svg+xml", words, width=width)
