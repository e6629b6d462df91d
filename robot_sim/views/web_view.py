"""The robot in a browser, in three dimensions: MuJoCo's own web viewer, reachable from this machine only."""

from __future__ import annotations

import copy
import time
from concurrent.futures import Future
from socket import create_connection, socket
from typing import Protocol

import mujoco

FRAMES = 25.0  # a second, real
LOOPBACK = "127.0.0.1"
STARTED_WITHIN = 30.0  # s


class Viewed(Protocol):
    """A robot in MuJoCo."""

    model: mujoco.MjModel
    data: mujoco.MjData


class WebView:
    """Shows a robot at ``url`` while ``show()`` is called; ``close()`` ends it.

    The browser draws; what leaves this process is the state, a few KB a frame. MuJoCo's viewer has no password and
    would listen on every interface, so it is bound to the loopback interface here.

    Args:
        robot: whom to show.
        port: where to listen; 0 takes the first free one from 8080 on.

    Raises:
        OSError: the port is taken.
        ImportError: this MuJoCo is older than 4.0 and has no web viewer.
    """

    def __init__(self, robot: Viewed, port: int = 0) -> None:
        # Only now: these imports take half a second, and a robot that nobody looks at does not need them.
        from mujoco.studio import launch_thread, viewer_protocol, web_viewer
        from mujoco.studio.web import web_server

        bind = web_server.bind_public_socket
        bound: Future[int] = Future()

        def bind_to_loopback(_host: str, wanted: int = 0) -> socket:
            try:
                listening = bind(LOOPBACK, wanted)
            except RuntimeError as error:
                bound.set_exception(OSError(str(error)))
                raise
            bound.set_result(listening.getsockname()[1])
            return listening

        web_server.bind_public_socket = bind_to_loopback
        web_viewer._print_url_banner = lambda host, port: (
            None
        )  # it names a network that this one is not bound to
        try:
            config = viewer_protocol.ViewerConfig(title="robot", gfx="web", http_port=port)
            camera = _following_camera(robot.model)
            self._viewer = launch_thread.launch_thread(
                lambda endpoint: viewer_protocol.run_viewer_loop(
                    web_viewer.WebViewer(config, endpoint, camera=camera)
                )
            )
            port = bound.result(STARTED_WITHIN)
        finally:
            web_server.bind_public_socket = bind
        self._robot = robot
        # Copies, because the viewer lets its user drag, reset and load whatever it was given.
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
            self._next_frame = now + 1 / FRAMES
            mujoco.mj_copyData(self._data, self._model, self._robot.data)
            self._viewer.sync()

    def close(self) -> None:
        """End the viewer."""
        self._viewer.close()


def _following_camera(model: mujoco.MjModel) -> mujoco.MjvCamera:
    """A camera in front of the robot that goes along with it and can be turned."""
    camera = mujoco.MjvCamera()
    camera.type = mujoco.mjtCamera.mjCAMERA_TRACKING
    free = int(model.jnt_type.argmin())  # mjJNT_FREE is 0, the least: a floating base has the first of them
    camera.trackbodyid = model.jnt_bodyid[free]
    camera.distance, camera.azimuth, camera.elevation = 2.6, 150.0, -12.0
    return camera


def _wait_for_the_server(port: int) -> None:
    end = time.monotonic() + STARTED_WITHIN
    while True:
        try:
            return create_connection((LOOPBACK, port), timeout=1.0).close()
        except OSError:
            if time.monotonic() > end:
                raise
            time.sleep(0.02)
