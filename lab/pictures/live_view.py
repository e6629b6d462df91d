"""Shows a live view of the robot, beside the notebook or in it."""

from __future__ import annotations

import io
import threading
import time

import ipywidgets
import numpy as np
from IPython.display import HTML
from PIL import Image
from traitlets import Unicode

from lab.client import topics
from lab.errors import NoRobotError
from lab.pictures.panel import Panel
from lab.pictures.picture import HEIGHT, WIDTH, body_to_draw, set_current_posture
from robot_sim.humanoid import Humanoid
from robot_sim.views.view import View
from ros_runtime.notebook_domains import is_notebook_of_a_lab, robot_of_another_notebook
from ros_runtime.workarounds.gl_backend import NoOpenGLError

MAX_FRAME_RATE = 12.0  # Hz
MAX_DRAWING_SHARE = 0.4  # of the time; the rest is left for the notebook's other threads
MESSAGE_TIMEOUT = 0.5  # s
FIRST_FRAME_TIMEOUT = 20.0  # s
PANEL_SIZE = 360, 480  # px, a narrow panel is higher than wide
NO_MESSAGE = "No message comes from the robot. If it was stopped, lab.start_robot() starts it."
SEEN_MOTION = 1e-4  # m and rad; a robot that moves less is not drawn again

_running: _LiveView | None = None


def watch_robot(camera: str = "track") -> ipywidgets.Image | ipywidgets.Label | HTML:
    """Show a live view of the robot until `stop_watching()`, or until another cell calls this.

    In `course lab` it is in a panel beside the notebook, elsewhere below this cell. The view is drawn in the notebook's
    process from the robot's own messages, so it does not slow the robot down; while the robot stands still, nothing is
    drawn. `camera` is "track", "side" or "front". Without OpenGL you get a text that says why there is no picture.

    Raises:
        NoRobotError: no robot is running.
        ValueError: there is no such camera.
    """
    topics.odometry()  # raises at once when there is no robot
    view = _running
    if view and view.panel and view.camera == camera and view.is_drawing:
        view.panel.open()
    else:
        view = _watch(camera)
    try:
        view.wait_for_first_frame()
    except NoOpenGLError as error:
        return ipywidgets.Label(f"No picture: {error}")
    if view.panel:
        return HTML("<p>The robot is shown on the right, in the panel “Robot”.</p>")
    return view.widget


def watch_beside_the_notebook() -> None:
    """In `course lab`, show the robot beside the notebook if it is not shown yet, without waiting for a picture."""
    if is_notebook_of_a_lab() and (_running is None or _running.lost_its_robot):
        _watch("track")


def stop_watching() -> None:
    """Stop the live view; its panel closes, and below a cell its last frame stays visible."""
    global _running
    if _running is not None:
        _running.end()
        _running = None


def _watch(camera: str) -> _LiveView:
    global _running
    stop_watching()
    _running = _LiveView(camera)
    return _running


class _Picture(ipywidgets.Image):
    """An image whose `tooltip` is its text alternative: a browser reads the title where there is no alt."""

    description = Unicode("").tag(sync=True)  # without it, ipywidgets' script fails when it sets a title


class _LiveView:
    """A widget, and the thread that draws into it; one thread does all drawing, because OpenGL requires that."""

    def __init__(self, camera: str) -> None:
        self.camera = camera
        in_panel = is_notebook_of_a_lab()
        width, height = PANEL_SIZE if in_panel else (WIDTH, HEIGHT)
        self.widget = _Picture(tooltip="The robot", format="jpeg", width=width, height=height)
        self.panel = Panel(self.widget) if in_panel else None
        self._size = width, height
        self._stop = threading.Event()
        self._begun = threading.Event()
        self._problem: Exception | None = None
        self._thread = threading.Thread(target=self._draw_until_stopped, name="live view", daemon=True)
        self._thread.start()

    @property
    def is_drawing(self) -> bool:
        """Whether the view has not ended."""
        return self._thread.is_alive()

    @property
    def lost_its_robot(self) -> bool:
        """Whether the view has ended because another notebook has started a robot."""
        return not self.is_drawing and self._problem is None

    def wait_for_first_frame(self) -> None:
        """Wait for the first frame; raise the error that prevented it."""
        if not self._begun.wait(FIRST_FRAME_TIMEOUT):
            self._problem = NoOpenGLError(f"nothing was drawn within {FIRST_FRAME_TIMEOUT:g} s")
        if self._problem is not None:
            self._stop.set()
            raise self._problem

    def end(self) -> None:
        self._stop.set()
        self._thread.join()

    def _draw_until_stopped(self) -> None:
        try:
            while not self._stop.is_set():
                body = body_to_draw()
                view = View(body, *self._size, shadows=False)
                try:
                    self._draw(body, view)
                finally:
                    view.close()
        except (NoOpenGLError, ValueError) as error:
            self._problem = error
        if self.panel:
            self.panel.close()
        self._begun.set()

    def _draw(self, body: Humanoid, view: View) -> None:
        """Draw until the view is stopped, or another robot or scene was started."""
        drawn = np.full(body.model.nq, np.inf)
        while not self._stop.is_set() and (topics.scene(), topics.robot()) == (body.scene, body.body.name):
            spent = 0.0  # s, on drawing
            moved, has_robot = False, True
            try:
                topics.latest("odom", MESSAGE_TIMEOUT)
                set_current_posture(body)
                text = topics.whereabouts()  # of the same moment as the picture
                text += ". lab.restart_robot() sets it up again." * text.startswith("FALLEN")
                moved = bool(abs(body.data.qpos - drawn).max() > SEEN_MOTION)
            except NoRobotError:  # the robot may be started again
                has_robot = False
                text = "The robot is starting." if topics.is_starting() else NO_MESSAGE
                if self.panel and robot_of_another_notebook():
                    self._stop.set()
            if moved:
                began = time.monotonic()
                drawn = body.data.qpos.copy()
                self.widget.value = _jpeg(view.picture(self.camera))
                spent = time.monotonic() - began
            self.widget.tooltip = f"The robot: {text}"
            if self.panel:
                self.panel.write(text, is_live=has_robot)
            self._begun.set()
            self._stop.wait(max(1 / MAX_FRAME_RATE - spent, spent * (1 / MAX_DRAWING_SHARE - 1)))


def _jpeg(pixels) -> bytes:  # (height, width, 3) uint8
    buffer = io.BytesIO()
    Image.fromarray(pixels).save(buffer, "JPEG", quality=85)
    return buffer.getvalue()
