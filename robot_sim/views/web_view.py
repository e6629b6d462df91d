"""The robot in a browser, in three dimensions: MuJoCo's own web viewer, reachable from this machine only."""

from __future__ import annotations

import copy
import time
from collections.abc import Sequence
from socket import create_connection
from typing import Protocol

import mujoco

from ros_runtime.workarounds.mujoco_web_viewer import LOOPBACK, START_TIMEOUT, launch_web_viewer

FRAME_RATE = 25.0  # Hz, real time


class Viewed(Protocol):
    """A robot in MuJoCo."""

    model: mujoco.MjModel
    data: mujoco.MjData


class WebView:
    """Shows a robot at `url` while `show()` is called; `close()` ends it.

    The browser draws; this process sends only the state, a few KB a frame. There is no password, so the view
    can be reached from this machine only.

    Args:
        robot: the robot to show.
        port: where to listen; 0 takes the first free one from 8080 on.

    Raises:
        OSError: the port is taken.
        ImportError: this MuJoCo is older than 4.0 and has no web viewer.
    """

    def __init__(self, robot: Viewed, port: int = 0) -> None:
        from robot_sim.views.web_text import WebText  # imported late, like the viewer: it takes half a second

        self._text = WebText()
        self._viewer, port = launch_web_viewer(port, _following_camera(robot.model), [self._text])
        self._robot = robot
        # Copies, because the viewer's user can drag and reset the model and load another one.
        self._model = copy.copy(robot.model)
        self._data = mujoco.MjData(self._model)
        self._viewer.set_model(self._model, data=self._data)
        self._next_frame = 0.0
        _wait_for_the_server(port)
        self.url = f"http://{LOOPBACK}:{port}/"

    def show(self) -> None:
        """Send the present state when the next frame is due."""
        now = time.monotonic()
        if now >= self._next_frame:
            self._next_frame = now + 1 / FRAME_RATE
            mujoco.mj_copyData(self._data, self._model, self._robot.data)
            self._viewer.sync()

    def write(self, lines: Sequence[tuple[str, str]]) -> None:
        """Show lines of text over the picture from now on, each with its colour, #rrggbb."""
        self._text.lines = lines

    def close(self) -> None:
        """Stop the viewer."""
        self._viewer.close()


def _following_camera(model: mujoco.MjModel) -> mujoco.MjvCamera:
    """Return a camera in front of the robot that follows it and can be turned."""
    camera = mujoco.MjvCamera()
    camera.type = mujoco.mjtCamera.mjCAMERA_TRACKING
    free = int(model.jnt_type.argmin())  # the first free joint: mjJNT_FREE is 0, the smallest type
    camera.trackbodyid = model.jnt_bodyid[free]
    camera.distance, camera.azimuth, camera.elevation = 2.6, 150.0, -12.0
    return camera


def _wait_for_the_server(port: int) -> None:
    end = time.monotonic() + START_TIMEOUT
    while True:
        try:
            return create_connection((LOOPBACK, port), timeout=1.0).close()
        except OSError:
            if time.monotonic() > end:
                raise
            time.sleep(0.02)
