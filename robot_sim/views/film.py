"""Films of the robot as animated WebP, which browsers, notebooks and slides can play."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import BinaryIO, Literal

from PIL import Image

from robot_sim.humanoid import Humanoid
from robot_sim.views.view import View

RATE = 25.0  # frames a second
QUALITY = 70  # of 100


def film(
    humanoid: Humanoid,
    seconds: float,
    file: Path | str | BinaryIO,
    *,
    camera: str = "track",
    each_step: Callable[[], object] = lambda: None,
) -> None:
    """Simulate for `seconds` and write a film of it to `file`; `each_step` is called before every timestep.

    Raises:
        ValueError: the duration is not positive, or the model has no such camera.
        NoOpenGLError: this machine cannot draw.
    """
    if not (math.isfinite(seconds) and seconds > 0):
        raise ValueError(f"the film would last {seconds} s; expected a positive number")
    reel = Reel(humanoid, camera=camera)
    try:
        began = humanoid.time
        for frame in range(max(1, round(seconds * RATE))):
            while humanoid.time - began < frame / RATE - humanoid.timestep / 2:
                each_step()
                humanoid.step()
            reel.add()
        reel.save(file)
    finally:
        reel.close()


class Reel:
    """A sequence of pictures of one robot; call `close()` at the end, because it holds an OpenGL context.

    Args:
        humanoid: the robot to film.
        width, height: px.
        camera: "track", "side", "front" or "head_camera".
        rate: frames a second at which it is played.

    Raises:
        NoOpenGLError: this machine cannot draw.
    """

    def __init__(
        self,
        humanoid: Humanoid,
        width: int = 480,
        height: int = 360,
        *,
        camera: str = "track",
        rate: float = RATE,
    ) -> None:
        self._view = View(humanoid, width, height, shadows=False)
        self._camera = camera
        self._rate = rate
        self._frames: list[Image.Image] = []

    def add(self) -> None:
        """Add a picture of the robot's present state.

        Raises:
            ValueError: the model has no such camera.
        """
        self._frames.append(Image.fromarray(self._view.picture(self._camera)))

    def save(self, file: Path | str | BinaryIO) -> None:
        """Write all frames as a film that repeats.

        Raises:
            ValueError: there are none.
        """
        if not self._frames:
            raise ValueError("there are no frames to save; add() some first")
        save_frames(file, self._frames, "WEBP", self._rate)

    def close(self) -> None:
        """Free the OpenGL context."""
        self._view.close()


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
