"""A film of the robot, stored in the notebook."""

from __future__ import annotations

import io
import time
from html import escape
from pathlib import Path

from IPython.display import HTML

from lab import topics
from lab.picture import HEIGHT, WIDTH, figure, take_posture
from robot_sim.humanoid import Humanoid
from robot_sim.views.film import Reel
from ros_runtime.workarounds.gl_backend import NoOpenGLError

RATE = 12.5  # frames a second
LONGEST = 60.0  # s, which are about 5 MB in the notebook


def film_robot(seconds: float = 5.0, file: str | Path | None = None, *, camera: str = "track") -> HTML:
    """Film the robot for `seconds` from now on, drawn from its own messages; also write it to `file`, a .webp.

    It blocks that long: start the motion before it, without waiting for the end of the motion. Without OpenGL you get
    the caption of the film and the reason why there is none.

    Raises:
        NoRobotError: no robot is running.
        ValueError: the duration is not between 0 and 60 s, or there is no such camera.
    """
    if not 0 < seconds <= LONGEST:
        raise ValueError(f"the film would last {seconds} s; expected more than 0, at most {LONGEST:g}")
    words = f"The robot for {seconds:g} s, from {topics.pose()}"
    body = Humanoid()
    try:
        reel = Reel(body, WIDTH, HEIGHT, camera=camera, rate=RATE)
    except NoOpenGLError as error:
        return HTML(f"<p>{escape(words)}. No film: {escape(str(error))}</p>")
    webp = io.BytesIO()
    try:
        began = time.monotonic()
        for frame in range(max(1, round(seconds * RATE))):
            time.sleep(max(0.0, began + frame / RATE - time.monotonic()))
            take_posture(body)
            reel.add()
        reel.save(webp)
    finally:
        reel.close()
    if file is not None:
        Path(file).write_bytes(webp.getvalue())
    return figure(webp.getvalue(), "webp", words, f"{words}, to {topics.pose()}")
