"""Pictures of the robot with captions below them."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from pathlib import Path

import matplotlib
import numpy as np
from PIL import Image, ImageDraw, ImageFont

from autograder.recording.replay.captions import LINES, captions
from autograder.recording.replay.moment import Moment

SIZE = 13  # px, of the letters
LEADING = 17  # px from line to line
MARGIN = 8  # px
BACKGROUND = "#16181d"


def with_captions(picture: np.ndarray, t: float, moments: Sequence[Moment]) -> Image.Image:
    """Return a picture (height x width x 3, RGB) with the captions of a time (s)."""
    height, width = picture.shape[:2]
    image = Image.new("RGB", (width, height + band_height()), BACKGROUND)
    image.paste(Image.fromarray(picture), (0, 0))
    draw = ImageDraw.Draw(image)
    letters = max(20, int((width - 2 * MARGIN) / draw.textlength("n", font=_font())))
    for number, caption in enumerate(captions(t, moments, letters)):
        place = (MARGIN, height + MARGIN + number * LEADING)
        draw.text(place, caption.text, font=_font(), fill=caption.colour)
    return image


def band_height() -> int:
    """How high (px) the text below a picture is: the time and the moments."""
    return (LINES + 1) * LEADING + 2 * MARGIN


@cache
def _font() -> ImageFont.FreeTypeFont:
    """The font that comes with matplotlib: it has the signs that a message may hold."""
    return ImageFont.truetype(Path(matplotlib.get_data_path(), "fonts/ttf/DejaVuSans.ttf"), SIZE)
