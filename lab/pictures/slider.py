"""Shows a slider below a picture, which is drawn again for each value of the slider."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import ipywidgets
from IPython.display import HTML


def slide(
    name: str, values: Sequence[float], draw: Callable[[float], HTML], *, start: float
) -> ipywidgets.VBox:
    """Show the picture that `draw` returns for a value, and a slider to choose one of `values`; it begins at `start`.

    lab.slide("shortest, m", (0.0, 0.2, 1.0), draw, start=0.2)
    """
    slider = ipywidgets.SelectionSlider(
        options=[(f"{value:g}", value) for value in values], value=start, description=name
    )
    picture = ipywidgets.HTML(draw(start).data)

    def show(change: dict[str, float]) -> None:
        picture.value = draw(change["new"]).data

    slider.observe(show, names="value")
    return ipywidgets.VBox([picture, slider])
