"""Pictures of the robot with what happened written below them."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from functools import cache
from pathlib import Path

import matplotlib
import numpy as np
from PIL import Image, ImageDraw, ImageFont

from replay.moment import Kind, Moment

LINES = 7  # of text below a picture
SIZE = 13  # px, of the letters
LEADING = 17  # px from line to line
MARGIN = 8  # px
FRESH = 2.5  # s for which a moment is shown; what a check found stays
FRESH_FEEDBACK = 1.0  # s
COLOURS = {
    Kind.EVENT: "#e8e8e8",
    Kind.FEEDBACK: "#8fb8de",
    Kind.OUTPUT: "#9ad0d0",
    Kind.PASSED: "#7fd67f",
    Kind.FAILED: "#ff7b72",
    Kind.TROUBLE: "#f0c674",
}
BACKGROUND = "#16181d"


def with_captions(picture: np.ndarray, t: float, moments: Sequence[Moment]) -> Image.Image:
    """Return a picture with the time (s) and the moments that are fresh then, the newest last.

    Verdicts stay; where there is not room for all, failed checks come first, then what is newest.
    """
    height, width = picture.shape[:2]
    image = Image.new("RGB", (width, height + band_height()), BACKGROUND)
    image.paste(Image.fromarray(picture), (0, 0))
    draw = ImageDraw.Draw(image)
    top = height + MARGIN
    draw.text((MARGIN, top), f"{t:.2f} s", font=_font(), fill="#ffffff")
    letters = max(20, int((width - 2 * MARGIN) / draw.textlength("n", font=_font())))
    for number, (text, colour) in enumerate(_chosen(t, moments, letters), start=1):
        draw.text((MARGIN, top + number * LEADING), text, font=_font(), fill=colour)
    return image


def band_height() -> int:
    """How high (px) the text below a picture is."""
    return (LINES + 1) * LEADING + 2 * MARGIN


def _chosen(t: float, moments: Sequence[Moment], letters: int) -> list[tuple[str, str]]:
    """Choose the lines to show at a time."""
    shown = [moment for moment in moments if _is_shown(moment, t)]
    feedback = [moment for moment in shown if moment.kind is Kind.FEEDBACK][-1:]
    shown = [moment for moment in shown if moment.kind is not Kind.FEEDBACK or moment in feedback]
    left, chosen = LINES, []
    for moment in sorted(shown, key=lambda each: (each.kind is not Kind.FAILED, -each.t)):
        wanted = 3 if moment.kind is Kind.FAILED else 1
        lines = _wrapped(moment.text, letters, min(wanted, left))
        if not lines:
            break
        left -= len(lines)
        chosen.append((moment, lines))
    return [
        (text, COLOURS[moment.kind])
        for moment, lines in sorted(chosen, key=lambda each: each[0].t)
        for text in lines
    ]


def _is_shown(moment: Moment, t: float) -> bool:
    if moment.t > t:
        return False
    if moment.kind is Kind.FAILED:
        return True
    return t - moment.t <= (FRESH_FEEDBACK if moment.kind is Kind.FEEDBACK else FRESH)


def _wrapped(text: str, letters: int, most: int) -> list[str]:
    return textwrap.wrap(text, letters, max_lines=most, placeholder=" …") if most > 0 else []


@cache
def _font() -> ImageFont.FreeTypeFont:
    """The font that comes with matplotlib: it has the signs that a message may hold."""
    return ImageFont.truetype(Path(matplotlib.get_data_path(), "fonts/ttf/DejaVuSans.ttf"), SIZE)
