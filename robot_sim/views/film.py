"""Films as animated WebP or GIF, which browsers, notebooks and slides can play."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import BinaryIO, Literal

from PIL import Image

QUALITY = 70  # of 100


def save_frames(
    file: Path | str | BinaryIO,
    frames: Sequence[Image.Image],
    kind: Literal["WEBP", "GIF"],
    rate: float,
    *,
    last: float = 0.0,
) -> None:
    """Write frames as a film that repeats.

    Args:
        file: the file to write to.
        frames: at least one.
        kind: "WEBP", or "GIF", which is larger and coarser but which older programs can play, too.
        rate: frames a second.
        last: s by which the last frame is shown longer.
    """
    if kind == "GIF":  # octree quantization keeps the colour of the few red letters
        frames = [
            frame.quantize(256, Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE) for frame in frames
        ]
    first, *others = frames
    durations = [round(1000 / rate)] * len(frames)
    durations[-1] += round(1000 * last)
    options = {"quality": QUALITY, "method": 2} if kind == "WEBP" else {"optimize": False, "disposal": 1}
    first.save(file, kind, save_all=True, append_images=others, duration=durations, loop=0, **options)
