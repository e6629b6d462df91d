"""Makes a film of a recorded arena, with goals, feedback and verdicts below the picture."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import BinaryIO, Literal

import matplotlib
import numpy as np
from PIL import Image, ImageDraw, ImageFont

from autograder.recording.replay.body import RecordedBody
from autograder.recording.replay.captions import Caption, captions
from autograder.recording.replay.recording import Recording, Span
from robot_sim.views.film import save_frames
from robot_sim.views.view import View

FRAME_RATE = 12.5  # frames a second
MAX_DURATION = 60.0  # s
WIDTH, HEIGHT = 480, 360  # px of the picture without the text
LAST_FRAME_DURATION = 1.5  # s, so that the verdict can be read
Format = Literal["WEBP", "GIF"]
FORMATS: Mapping[str, Format] = {".webp": "WEBP", ".gif": "GIF"}
FONT_SIZE = 13  # px
LINE_HEIGHT = 17  # px
MARGIN = 8  # px
BACKGROUND = "#16181d"


def film(
    recording: Recording,
    span: Span,
    file: Path | BinaryIO,
    kind: Format = "WEBP",
    *,
    camera: str = "track",
    speed: float = 1.0,
) -> int:
    """Write a film of the robot in this span, played `speed` times as fast; return the number of frames.

    Raises:
        ValueError: the span is too long, or there is no such camera.
        NoOpenGLError: this machine cannot draw pictures.
    """
    duration = (span.end - span.start) / speed
    if duration > MAX_DURATION:
        raise ValueError(
            f"the film would last {duration:.0f} s, but the limit is {MAX_DURATION:g} s: choose a part "
            "with --seconds and --around"
        )
    frames = _frames(recording, span, camera, FRAME_RATE / speed)
    save_frames(file, frames, kind, FRAME_RATE, last=LAST_FRAME_DURATION)
    return len(frames)


def format_of(file: Path) -> Format:
    """Return the format of a film file, by its suffix; raises ValueError if it is not in FORMATS."""
    if file.suffix.lower() not in FORMATS:
        raise ValueError(
            f"{file.name} has the suffix {file.suffix or '“”'}; expected {' or '.join(FORMATS)} (ffmpeg converts these "
            "to other formats)"
        )
    return FORMATS[file.suffix.lower()]


def _frames(recording: Recording, span: Span, camera: str, rate: float) -> list[Image.Image]:
    """Return the pictures of a span, `rate` of them for each second of the recording."""
    body = RecordedBody(recording)
    view = View(body.humanoid, WIDTH, HEIGHT, shadows=False)
    count = max(1, math.ceil((span.end - span.start) * rate) + 1)
    times = [min(span.start + number / rate, span.end) for number in range(count)]
    caption_width = int((WIDTH - 2 * MARGIN) / _font().getlength("n"))  # characters
    texts = [captions(t, recording.moments, caption_width) for t in times]
    below = max(map(len, texts)) * LINE_HEIGHT + 2 * MARGIN  # px

    def postures() -> Iterator[None]:
        for t in times:
            body.show(t)
            yield

    try:
        view.fit(camera, postures())
        return [
            _with_captions(view.picture(camera), lines, below)
            for lines, _ in zip(texts, postures(), strict=True)
        ]
    finally:
        view.close()


def _with_captions(picture: np.ndarray, lines: Sequence[Caption], below: int) -> Image.Image:
    """Return a picture (height x width x 3, RGB) with captions in `below` px below it."""
    height, width = picture.shape[:2]
    image = Image.new("RGB", (width, height + below), BACKGROUND)
    image.paste(Image.fromarray(picture), (0, 0))
    draw = ImageDraw.Draw(image)
    for number, caption in enumerate(lines):
        place = (MARGIN, height + MARGIN + number * LINE_HEIGHT)
        draw.text(place, caption.text, font=_font(), fill=caption.colour)
    return image


@cache
def _font() -> ImageFont.FreeTypeFont:
    """Return the font that comes with matplotlib, which has most characters that a message may contain."""
    return ImageFont.truetype(Path(matplotlib.get_data_path(), "fonts/ttf/DejaVuSans.ttf"), FONT_SIZE)
