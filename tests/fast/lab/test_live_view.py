"""The live picture is drawn only while the robot moves, and its panel says what becomes of the robot."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from types import SimpleNamespace

import numpy as np
import pytest

from lab.errors import NoRobotError
from lab.pictures import live_view, panel
from ros_runtime.workarounds.gl_backend import NoOpenGLError

TIMEOUT = 20.0  # s, for a thread on a busy machine


class Robot:
    """What the lab knows of a robot, without ROS: the height of its body, or the error because it has ended."""

    def __init__(self) -> None:
        self.scene, self.name = "flat", "humanoid"
        self.height = 0.7
        self.error: NoRobotError | None = None
        self.taken = self.starting = False
        self.drawn: list[tuple[str, float]] = []  # scene and height of each picture

    def set_posture(self, body: SimpleNamespace) -> None:
        if self.error:
            raise self.error
        body.data.qpos[2] = self.height


@pytest.fixture
def robot(monkeypatch: pytest.MonkeyPatch) -> Iterator[Robot]:
    robot = Robot()

    class View:
        def __init__(self, body: SimpleNamespace, *_size: int, shadows: bool) -> None:
            self.body = body

        def picture(self, camera: str) -> np.ndarray:
            robot.drawn.append((self.body.scene, self.body.data.qpos[2]))
            return np.zeros((4, 4, 3), np.uint8)

        def close(self) -> None:
            pass

    def body() -> SimpleNamespace:
        return SimpleNamespace(
            scene=robot.scene,
            body=SimpleNamespace(name=robot.name),
            model=SimpleNamespace(nq=7),
            data=SimpleNamespace(qpos=np.zeros(7)),
        )

    fakes = {
        "odometry": lambda: None,
        "scene": lambda: robot.scene,
        "robot": lambda: robot.name,
        "is_starting": lambda: robot.starting,
        "latest": lambda topic, timeout: None,
        "whereabouts": lambda: "OFF at x",
    }
    monkeypatch.setattr(live_view, "topics", SimpleNamespace(**fakes))
    monkeypatch.setattr(live_view, "body_to_draw", body)
    monkeypatch.setattr(live_view, "View", View)
    monkeypatch.setattr(live_view, "set_current_posture", robot.set_posture)
    monkeypatch.setattr(live_view, "is_notebook_of_a_lab", lambda: True)
    monkeypatch.setattr(live_view, "robot_of_another_notebook", lambda: robot.taken)
    monkeypatch.setattr(panel, "BEAT_PERIOD", 0.0)
    monkeypatch.setenv("JPY_SESSION_NAME", "chapters/chapter.ipynb")
    yield robot
    live_view.stop_watching()


def watched() -> live_view._LiveView:
    live_view.watch_beside_the_notebook()
    assert live_view._running
    live_view._running.wait_for_first_frame()
    return live_view._running


def wait_until(condition: Callable[[], bool]) -> None:
    end = time.monotonic() + TIMEOUT
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.01)


def text(view: live_view._LiveView) -> str:
    assert view.panel
    return view.panel._text.value


def test_a_robot_that_stands_still_is_drawn_once_and_its_text_goes_on(robot: Robot) -> None:
    view = watched()
    first = text(view)
    wait_until(lambda: text(view) != first)
    assert "OFF at x" in text(view)
    assert "The robot of chapter.ipynb" in text(view)
    assert robot.drawn == [("flat", 0.7)]
    robot.height = 0.6
    wait_until(lambda: robot.drawn == [("flat", 0.7), ("flat", 0.6)])


def test_a_robot_in_another_scene_is_drawn_in_it(robot: Robot) -> None:
    watched()
    robot.scene = "table"
    wait_until(lambda: robot.drawn[-1] == ("table", 0.7))


def test_the_panel_says_that_no_message_comes_dims_its_picture_and_goes_on_with_the_next_robot(
    robot: Robot,
) -> None:
    view = watched()
    robot.starting, robot.error = True, NoRobotError("no message arrived")
    wait_until(lambda: "The robot is starting." in text(view))
    robot.starting = False
    wait_until(lambda: "No message comes from the robot." in text(view))
    assert view.panel
    assert "course-still" in view.panel._box._dom_classes
    robot.error = None
    wait_until(lambda: "OFF at x" in text(view))
    assert "course-still" not in view.panel._box._dom_classes


def test_the_panel_closes_when_another_notebook_has_the_robot_and_opens_when_it_is_back(robot: Robot) -> None:
    view = watched()
    robot.taken, robot.error = True, NoRobotError("it ended")
    wait_until(lambda: view.lost_its_robot)
    assert view.panel
    assert view.panel._sidecar
    assert view.panel._sidecar.comm is None
    robot.taken, robot.error = False, None
    assert watched() is not view


def test_a_second_start_keeps_the_view_and_watch_robot_opens_a_closed_panel(robot: Robot) -> None:
    view = watched()
    assert view.panel
    opened = view.panel._sidecar
    assert watched() is view
    assert view.panel._sidecar is opened
    assert "on the right" in str(live_view.watch_robot().data)
    assert live_view._running is view
    assert view.panel._sidecar is not opened


def test_without_opengl_nothing_opens_at_the_next_start(
    robot: Robot, monkeypatch: pytest.MonkeyPatch
) -> None:
    def no_view(*_arguments: object, **_options: object) -> None:
        raise NoOpenGLError("no OpenGL here")

    monkeypatch.setattr(live_view, "View", no_view)
    with pytest.raises(NoOpenGLError, match="no OpenGL here"):
        watched()
    broken = live_view._running
    live_view.watch_beside_the_notebook()
    assert live_view._running is broken
    assert "no OpenGL here" in live_view.watch_robot().value
