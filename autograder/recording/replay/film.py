"""A recorded arena as a film, with goals, feedback and verdicts below the picture."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Literal

import matplotlib
import numpy as np
from PIL import Image, ImageDraw, ImageFont

from autograder.recording.replay.body import RecordedBody
from autograder.recording.replay.captions import LINES, captions
from autograder.recording.replay.recording import Moment, Recording, Span
from robot_sim.views.film import save_frames
from robot_sim.views.view import View

RATE = 12.5  # frames a second
MAX_DURATION = 60.0  # s
WIDTH, HEIGHT = 480, 360  # px of the picture without the text
LAST_FRAME = 1.5  # s for which the last frame is shown, so that the verdict can be read
FORMATS: Mapping[str, Literal["WEBP", "GIF"]] = {".webp": "WEBP", ".gif": "GIF"}
SIZE = 13  # px, of the letters
LEADING = 17  # px from line to line
MARGIN = 8  # px
BACKGROUND = "#16181d"


def film(recording: Recording, span: Span, file: Path, *, camera: str = "track") -> int:
    """Write a film of the robot in this span; return the number of its frames.

    Raises:
        ValueError: the ending of the file's name is not known, the span is too long, or there is no such camera.
        NoRecording: the recorded robot is another one.
        NoOpenGLError: this machine cannot draw.
    """
    require_known_format(file)
    if span.end - span.start > MAX_DURATION:
        raise ValueError(
            f"the film would last {span.end - span.start:.0f} s; at most {MAX_DURATION:g} are filmed: choose with "
            "--seconds and --around"
        )
    frames = _frames(recording, span, camera)
    save_frames(file, frames, FORMATS[file.suffix.lower()], RATE, last=LAST_FRAME)
    return len(frames)


def require_known_format(file: Path) -> None:
    """Require a file name with a known film format."""
    if file.suffix.lower() not in FORMATS:
        raise ValueError(
            f"{file.name} ends in {file.suffix or 'nothing'}; a film here ends in {' or '.join(FORMATS)} "
            "(make others of it with ffmpeg)"
        )


def _frames(recording: Recording, span: Span, camera: str) -> list[Image.Image]:
    body = RecordedBody(recording)
    view = View(body.humanoid, WIDTH, HEIGHT, shadows=False)
    frames = []
    try:
        for number in range(max(1, math.ceil((span.end - span.start) * RATE) + 1)):
            t = min(span.start + number / RATE, span.end)
            body.show(t)
            frames.append(with_captions(view.picture(camera), t, recording.moments))
    finally:
        view.close()
    return frames


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
