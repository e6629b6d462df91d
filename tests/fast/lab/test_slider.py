"""A slider redraws its picture for each value."""

from __future__ import annotations

import ipywidgets
from IPython.display import HTML

import lab


def test_the_picture_follows_the_slider() -> None:
    box = lab.slide("shortest, m", (0.0, 0.2, 1.0), lambda value: HTML(f"drawn for {value}"), start=0.2)
    picture, slider = box.children
    assert isinstance(picture, ipywidgets.HTML)
    assert picture.value == "drawn for 0.2"
    assert slider.description == "shortest, m"
    slider.value = 1.0
    assert picture.value == "drawn for 1.0"
    assert slider.label == "1"
