"""A curve in a panel with axes, as SVG: of a quantity over time, or of a path seen from above."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from ros_runtime.drawing.svg import svg
from ros_runtime.drawing.xml_text import escape

Point = tuple[float, float]

LEFT, TOP, RIGHT, BOTTOM = 64, 40, 24, 48  # px, as all below
FLAG_HEIGHT, TICK_ROW = 17, 16
MOST_POINTS = 400
CURVE, FLAG, DOT = "#1f5fa8", "#b34700", "#2c7a3f"


@dataclass(frozen=True)
class Flag:
    """A named moment: a vertical line at `x`, or a dot at (`x`, `y`)."""

    label: str
    x: float
    y: float | None = None


@dataclass(frozen=True)
class Plot:
    """A curve through `points`, with labelled axes, named moments, and ticks on the lower edge.

    `equal` gives both axes the same scale, as a map has; `least` is the smallest range (in units) that an axis shows.
    """

    title: str
    across: str
    up: str
    points: Sequence[Point]
    flags: Sequence[Flag] = ()
    ticks: Sequence[float] = ()
    ticks_are: str = ""
    equal: bool = False
    least: float = 0.1


def plot_svg(plot: Plot, *, width: int = 760, height: int = 200) -> str:
    """Draw a plot whose panel has so many px.

    Raises:
        ValueError: there is no point, or one is not finite.
    """
    if not plot.points or not all(math.isfinite(value) for point in plot.points for value in point):
        raise ValueError("a plot needs at least one point, and finite ones")
    lines = [flag for flag in plot.flags if flag.y is None]
    dots = [(flag.x, flag.y) for flag in plot.flags if flag.y is not None]
    xs = _range([x for x, _ in (*plot.points, *dots)] + [f.x for f in lines] + [*plot.ticks], plot.least)
    ys = _range([y for _, y in (*plot.points, *dots)] + ([] if plot.equal else [0.0]), plot.least)
    if plot.equal:
        xs, ys = _with_one_scale(xs, ys, width / height)
    top = TOP + FLAG_HEIGHT * len(lines)

    def place(x: float, y: float) -> Point:
        return (
            round(LEFT + width * (x - xs[0]) / (xs[1] - xs[0]), 1),
            round(top + height * (ys[1] - y) / (ys[1] - ys[0]), 1),
        )

    bottom = top + height
    parts = _axes(plot, xs, ys, width, height, top)
    curve = " ".join("{},{}".format(*place(*point)) for point in _thinned(plot.points))
    parts.append(
        f'<polyline points="{curve}" fill="none" stroke="{CURVE}" stroke-width="2" stroke-linejoin="round"/>'
    )
    for tick in plot.ticks:
        x, _ = place(tick, 0)
        parts.append(
            f'<line x1="{x}" y1="{bottom - 9}" x2="{x}" y2="{bottom}" stroke="{DOT}" stroke-width="1.5"/>'
        )
    for row, flag in enumerate(sorted(lines, key=lambda flag: flag.x), start=1):
        x, y = place(flag.x, 0)[0], TOP + FLAG_HEIGHT * row - 6.0
        parts += [
            f'<line x1="{x}" y1="{y - 8}" x2="{x}" y2="{bottom}" stroke="{FLAG}" stroke-dasharray="4 3"/>',
            _label(flag.label, x, y, 5, to_the_left=x > LEFT + width / 2),
        ]
    for index, flag in enumerate(plot.flags):
        if flag.y is not None:
            x, dot = place(flag.x, flag.y)
            y = dot + (18 if index % 2 else -8)  # above and below in turn: neighbours are often close
            parts += [
                f'<circle cx="{x}" cy="{dot}" r="5" fill="{FLAG}"/>',
                _label(flag.label, x, y, 9, to_the_left=x > LEFT + width / 2),
            ]
    return svg(
        parts,
        width=LEFT + width + RIGHT,
        height=top + height + BOTTOM,
        title=plot.title,
        words=_in_words(plot),
    )


def _label(text: str, x: float, y: float, gap: int, *, to_the_left: bool) -> str:
    """Write beside a point, on the side where there is room."""
    return (
        f'<text x="{x - gap if to_the_left else x + gap}" y="{y}" fill="{FLAG}" font-size="12" '
        f'text-anchor="{"end" if to_the_left else "start"}">{escape(text)}</text>'
    )


def _range(values: Sequence[float], least: float) -> tuple[float, float]:
    low, high = min(values), max(values)
    lacking = max(0.0, least - (high - low)) / 2
    margin = 0.04 * max(high - low, least)
    return low - lacking - margin, high + lacking + margin


def _with_one_scale(xs: Point, ys: Point, ratio: float) -> tuple[Point, Point]:
    """Widen one of two ranges until a unit has the same length on both axes of a panel with this ratio of sides."""
    across, up = xs[1] - xs[0], ys[1] - ys[0]
    if across < up * ratio:
        more = (up * ratio - across) / 2
        return (xs[0] - more, xs[1] + more), ys
    more = (across / ratio - up) / 2
    return xs, (ys[0] - more, ys[1] + more)


def _axes(plot: Plot, xs: Point, ys: Point, width: int, height: int, top: int) -> list[str]:
    parts = [
        f'<rect x="{LEFT}" y="{top}" width="{width}" height="{height}" fill="none" stroke="#999999"/>',
        f'<text x="{LEFT + width // 2}" y="{top + height + 38}" text-anchor="middle" fill="#555555">'
        f"{escape(plot.across)}{escape(f'; green: {plot.ticks_are}') if plot.ticks else ''}</text>",
        f'<text transform="translate(16 {top + height // 2}) rotate(-90)" text-anchor="middle" fill="#555555">'
        f"{escape(plot.up)}</text>",
    ]
    for value in _round_values(*xs, 8):
        x = LEFT + width * (value - xs[0]) / (xs[1] - xs[0])
        parts += [
            f'<line x1="{x:.1f}" y1="{top}" x2="{x:.1f}" y2="{top + height}" stroke="#e3e3e3"/>',
            f'<text x="{x:.1f}" y="{top + height + TICK_ROW}" text-anchor="middle" font-size="12">{value:g}</text>',
        ]
    for value in _round_values(*ys, 4):
        y = top + height * (ys[1] - value) / (ys[1] - ys[0])
        parts += [
            f'<line x1="{LEFT}" y1="{y:.1f}" x2="{LEFT + width}" y2="{y:.1f}" stroke="#e3e3e3"/>',
            f'<text x="{LEFT - 6}" y="{y + 4:.1f}" text-anchor="end" font-size="12">{value:g}</text>',
        ]
    return parts


def _round_values(low: float, high: float, about: int) -> list[float]:
    """Return about so many round numbers in a range."""
    rough = (high - low) / about
    power = 10.0 ** math.floor(math.log10(rough))
    step = next(power * factor for factor in (1, 2, 5, 10) if power * factor >= rough)
    first, last = math.ceil(low / step), math.floor(high / step)
    return [round(index * step, 10) for index in range(first, last + 1)]


def _thinned(points: Sequence[Point]) -> list[Point]:
    """Return at most MOST_POINTS and the last."""
    step = -(-len(points) // MOST_POINTS)
    return [*points[::step], points[-1]]


def _in_words(plot: Plot) -> str:
    (x0, y0), (x1, y1) = plot.points[0], plot.points[-1]
    most = max(y for _, y in plot.points)
    said = [
        f"{plot.up}: {y0:.2f} at first, {y1:.2f} at last, {most:.2f} at most; {plot.across}: {x0:.2f} to {x1:.2f}."
    ]
    said += [
        f"{flag.label}: at {flag.x:.2f}{'' if flag.y is None else f', {flag.y:.2f}'}." for flag in plot.flags
    ]
    if plot.ticks:
        said.append(
            f"{len(plot.ticks)} {plot.ticks_are} from {min(plot.ticks):.2f} to {max(plot.ticks):.2f}."
        )
    return " ".join(said)
