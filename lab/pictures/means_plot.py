"""A scatter plot of the means of two quantities, one point per recording."""

from __future__ import annotations

from collections.abc import Mapping

from IPython.display import HTML

from lab.errors import LabError
from lab.pictures.figure import BLUE, BOTTOM, LEFT, TOP, as_html, sheet
from lab.pictures.quantities import quantity_named
from lab.pictures.recording import Recording

WIDTH, HEIGHT = 4.8, 3.0  # inches
NAMES = 1.2  # inches on the right, for the name of the last point


def plot_means(recordings: Mapping[str, Recording], x: str, y: str, *, title: str = "Means") -> HTML:
    """Draw a point for each recording, at its means of two quantities; `recordings` maps names to recordings.

        lab.plot_means({"standing": first, "0.3 m/s": second}, "speed", "power")

    Raises LabError when there is no recording or no such quantity, or nothing of it was recorded.
    """
    if not recordings:
        raise LabError("there is nothing to plot: make recordings with lab.record_robot() first")
    points = {name: (recording.mean(x), recording.mean(y)) for name, recording in recordings.items()}
    across, up = (f"mean {name}, {quantity_named(name).unit}" for name in (x, y))
    width, height = LEFT + WIDTH + NAMES, TOP + HEIGHT + BOTTOM
    with sheet(width, height, title) as page:
        panel = page.add_axes((LEFT / width, BOTTOM / height, WIDTH / width, HEIGHT / height))
        panel.plot(*zip(*points.values(), strict=True), "o", color=BLUE, markersize=6.5)
        for name, point in points.items():
            panel.annotate(
                name,
                point,
                xytext=(8, -3),
                textcoords="offset points",
                annotation_clip=False,
                parse_math=False,
            )
        panel.set_xlabel(across)
        panel.set_ylabel(up)
        panel.set_ylim(bottom=min(0.0, panel.get_ylim()[0]))
        return as_html(
            page,
            " ".join(
                [
                    f"{title}.",
                    *(f"{name}: {across} {a:.2f}, {up} {b:.2f}." for name, (a, b) in points.items()),
                ]
            ),
        )
