"""Plots on the pages of a class: a figure of matplotlib as SVG, with its title and the same facts in words."""

from __future__ import annotations

import io
import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager

import matplotlib
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from ros_runtime.drawing.xml_text import escape

# Inches around the panel; fixed, because measuring the texts is slow.
LEFT, RIGHT, BELOW, ABOVE = 0.7, 0.2, 0.55, 0.3
CURVE, FLAG, DOT = "#1f5fa8", "#b34700", "#2c7a3f"
_STYLE = {"svg.fonttype": "none", "text.parse_math": False, "font.size": 9, "axes.edgecolor": "#999999"}
_NO_METADATA = dict.fromkeys(("Date", "Creator", "Format", "Type"))


class Plot:
    """One panel of a drawing; `svg` is set when the `with` block of `plotted` ends."""

    def __init__(self, width: float, height: float, above: float) -> None:
        self.figure = Figure(figsize=(width, height))
        self.axes: Axes = self.figure.add_axes(
            (LEFT / width, BELOW / height, 1.0 - (LEFT + RIGHT) / width, 1.0 - (above + BELOW) / height)
        )
        self.svg = ""


@contextmanager
def plotted(title: str, words: str, *, width: float, height: float, pad: float = 6.0) -> Iterator[Plot]:
    """Draw a plot in a `with` block; the same one has the same bytes.

    Args:
        title: above the panel.
        words: its text alternative.
        width: of the drawing, in.
        height: of the drawing, in.
        pad: between title and panel, pt.
    """
    with matplotlib.rc_context({**_STYLE, "svg.hashsalt": f"{title} {words}"}):
        plot = Plot(width, height, ABOVE + pad / 72)
        plot.axes.set_title(title, loc="left", fontweight="bold", pad=pad)
        yield plot
        page = io.StringIO()
        plot.figure.savefig(page, format="svg", metadata=_NO_METADATA)
    # A page has several drawings, whose ids must differ.
    drawn = re.sub(r'<g id="[^"]*">', "<g>", page.getvalue())
    box = re.search(r'viewBox="[^"]*"', drawn)
    assert box
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" {box[0]} '
        f'width="{96 * width:.0f}" role="img">\n<title>{escape(title)}</title>\n<desc>{escape(words)}</desc>'
    )
    plot.svg = re.sub(r"^.*?<svg\b[^>]*>", lambda _: head, drawn, count=1, flags=re.DOTALL)


def bars_svg(numbers: Mapping[str, int], *, title: str, across: str, up: str) -> str:
    """Draw whole numbers as bars by their labels, from left to right; `across` and `up` name the axes."""
    said = ", ".join(f"{label}: {number}" for label, number in numbers.items() if number)
    words = f"{up} by {across}: {said or 'none'}."
    with plotted(title, words, width=1.0 + 0.55 * len(numbers), height=2.3) as plot:
        bars = plot.axes.bar(list(numbers), list(numbers.values()), color=CURVE)
        plot.axes.bar_label(bars, [str(number or "") for number in numbers.values()])
        plot.axes.margins(y=0.2)
        plot.axes.set(xlabel=across, ylabel=up)
        plot.axes.yaxis.set_major_locator(MaxNLocator(4, integer=True))
    return plot.svg
