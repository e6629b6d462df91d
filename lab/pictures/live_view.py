"""Shows a live view of the robot in the notebook."""

from __future__ import annotations

import io
import threading
import time

import ipywidgets
from PIL import Image
from traitlets import Unicode

from lab.client import topics
from lab.errors import NoRobotError
from lab.pictures.picture import HEIGHT, WIDTH, set_current_posture
from robot_sim.humanoid import Humanoid
from robot_sim.views.view import View
from ros_runtime.workarounds.gl_backend import NoOpenGLError

MAX_FRAME_RATE = 12.0  # Hz
MAX_DRAWING_SHARE = 0.4  # of the time; the rest is left for the notebook's other threads
FIRST_FRAME_TIMEOUT = 20.0  # s

_running: _LiveView | None = None


def watch_robot(camera: str = "track") -> ipywidgets.Image | ipywidgets.Label:
    """Show a live view of the robot below this cell until `stop_watching()`, or until another cell calls this.

    The view is drawn in the notebook's process from the robot's own messages, so it does not slow the robot down.
    `camera` is "track", "side" or "front". Without OpenGL you get a text that says why there is no picture.

    Raises:
        NoRobotError: no robot is running.
        ValueError: there is no such camera.
    """
    global _running
    stop_watching()
    topics.odometry()  # raises at once when there is no robot
    view = _LiveView(camera)
    try:
        view.begin()
    except NoOpenGLError as error:
        return ipywidgets.Label(f"No picture: {error}")
    _running = view
    return view.widget


def stop_watching() -> None:
    """Stop the live view; its last frame stays visible."""
    global _running
    if _running is not None:
        _running.end()
        _running = None


class _Picture(ipywidgets.Image):
    """An image whose `tooltip` is its text alternative: a browser reads the title where there is no alt."""

    description = Unicode("").tag(sync=True)  # without it, ipywidgets' script fails when it sets a title


class _LiveView:
    """A widget, and the thread that draws into it; one thread does all drawing, because OpenGL requires that."""

    def __init__(self, camera: str) -> None:
        self.widget = _Picture(tooltip="The robot", format="jpeg", width=WIDTH, height=HEIGHT)
        self._camera = camera
        self._stop = threading.Event()
        self._begun = threading.Event()
        self._problem: Exception | None = None
        self._thread = threading.Thread(target=self._draw_until_stopped, name="live view", daemon=True)

    def begin(self) -> None:
        """Start the thread and wait for the first frame; raise the error that prevented it."""
        self._thread.start()
        if not self._begun.wait(FIRST_FRAME_TIMEOUT):
            self._problem = NoOpenGLError(f"nothing was drawn within {FIRST_FRAME_TIMEOUT:g} s")
        if self._problem is not None:
            self._stop.set()
            raise self._problem

    def end(self) -> None:
        self._stop.set()
        self._thread.join()

    def _draw_until_stopped(self) -> None:
        body = Humanoid(topics.scene())
        try:
            view = View(body, WIDTH, HEIGHT, shadows=False)
        except NoOpenGLError as error:
            self._problem = error
            self._begun.set()
            return
        try:
            self._draw(body, view)
        finally:
            view.close()

    def _draw(self, body: Humanoid, view: View) -> None:
        while not self._stop.is_set():
            began = time.monotonic()
            try:
                set_current_posture(body)
                self.widget.tooltip = f"The robot: {topics.mode()} at {topics.pose()}"
                self.widget.value = _jpeg(view.picture(self._camera))
            except NoRobotError:  # the robot may be started again
                pass
            except ValueError as error:
                self._problem = error
                self._stop.set()
            self._begun.set()
            spent = time.monotonic() - began
            self._stop.wait(max(1 / MAX_FRAME_RATE - spent, spent * (1 / MAX_DRAWING_SHARE - 1)))


def _jpeg(pixels) -> bytes:  # (height, width, 3) uint8
    buffer = io.BytesIO()
    Image.fromarray(pixels).save(buffer, "JPEG", quality=85)
    return buffer.getvalue()
