"""The figures of all plots: white, with the same fonts and colours, embedded as SVG."""

from __future__ import annotations

import io
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from IPython.display import HTML

from lab.pictures.labels import FONT_SIZE
from lab.pictures.picture import figure
from ros_runtime.cell_notice import notice

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PIXELS_PER_INCH = 96
LEFT, TOP, BOTTOM = 0.85, 0.42, 0.5  # inches, for the y labels, the title and the x axis
# From the palette of Okabe and Ito for colour-blind readers; figures can be understood without their colours.
BLUE: str = "#0072B2"
VERMILION: str = "#B34700"
GREY: str = "#555555"

_STYLE = {
    "font.size": FONT_SIZE,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "#e6e6e6",
    "svg.fonttype": "none",  # text stays text, which can be searched and copied
}


@contextmanager
def sheet(width: float, height: float, title: str) -> Iterator[Figure]:
    """Make a figure with a title in the style of the lab; `width` and `height` are in inches."""
    with notice("The first plot loads matplotlib, which takes some seconds."):
        import matplotlib
        from matplotlib.figure import Figure
    with matplotlib.rc_context(_STYLE):
        page = Figure((width, height), facecolor="white")
        page.text(0.12 / width, 1 - 0.1 / height, title, va="top", fontsize=FONT_SIZE + 2, fontweight="bold")
        yield page


@contextmanager
def panel(
    width: float, height: float, title: str, *, left: float = LEFT, right: float = 0.25, above: float = 0.0
) -> Iterator[tuple[Figure, Axes]]:
    """Make a figure with one panel; its `width` and `height` and the margins for texts around it are in inches."""
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
    """Write a text at an `offset` (points) from a place, even outside of the panel; $ and _ are printed as they are."""
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
