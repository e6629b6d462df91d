"""Films of a goal show its status, its phases and the robot's position, and have a text alternative."""

from __future__ import annotations

import base64
import io
import re
from html import unescape
from types import SimpleNamespace

import numpy as np
import pytest
from IPython.display import HTML
from PIL import Image
from sensor_msgs.msg import JointState
from stage import Stage

import lab
from humanoid_interfaces.action import NavigateToPose, WalkTo
from humanoid_interfaces.msg import RobotState
from lab.pictures.figure import BLUE, VERMILION
from lab.pictures.film import DRAWING, RATE
from lab.pictures.film_beside import CAPTURE_POINT, GOAL
from robot_sim.model.joint_names import ACTUATED_JOINTS
from ros_runtime import cell_notice
from ros_runtime.record.client_events import FeedbackReceived, GoalAnswered, GoalSent, ResultReceived

FLASHING = 1.2  # s, in the film of the trip


@pytest.fixture
def stage(monkeypatch: pytest.MonkeyPatch) -> Stage:
    monkeypatch.setattr(lab.client.topics, "scene", lambda: "flat")
    monkeypatch.setattr(lab.client.topics, "robot", lambda: "humanoid")
    return Stage(monkeypatch)


def frames(html: HTML) -> list[np.ndarray]:
    """The frames of the film in a figure, (height, width, 3) each."""
    found = re.search(r'data:image/webp;base64,([^"]+)"', html.data)
    assert found
    film = Image.open(io.BytesIO(base64.b64decode(found[1])))
    shown = []
    for number in range(film.n_frames):
        film.seek(number)
        shown.append(np.asarray(film.convert("RGB")).astype(int))
    return shown


def words(html: HTML) -> str:
    found = re.search(r'alt="([^"]*)"', html.data)
    assert found
    return unescape(found[1])


def near(picture: np.ndarray, colour: str, tolerance: int = 45) -> int:
    """The number of pixels of about this colour."""
    wanted = np.array([*bytes.fromhex(colour.removeprefix("#"))])
    return int((abs(picture - wanted).max(axis=2) < tolerance).sum())


def walk_past(stage: Stage, *, at: float) -> None:
    """Walk along x at 0.5 m/s for 2 s, to a goal 0.8 m ahead that succeeds at a time (s)."""
    goal = WalkTo.Goal()
    goal.target_pose.header.frame_id = "base_link"
    goal.target_pose.pose.position.x = 0.8
    stage.be(RobotState.WALKING, at=-0.1)
    for twentieth in range(-2, 62):
        t = twentieth / 20
        moved = min(max(t, 0.0), 2.0) * 0.5
        stage.walk(t, speed=0.5 if t < 2.0 else 0.0, height=0.65, x=1.0, y=2.0 + moved, yaw=np.pi / 2)
        joints = JointState(name=[*ACTUATED_JOINTS], position=[0.0] * len(ACTUATED_JOINTS))
        stage.publish("joint_states", joints, t)
    stage.recording.add_event(GoalSent(t=1000.0, goal="go 1", action="go", request=goal))
    stage.recording.add_event(GoalAnswered(t=1000.02, goal="go 1", accepted=True))
    stage.recording.add_event(ResultReceived(t=1000.0 + at, goal="go 1", status=4, result=WalkTo.Result()))
    stage.be(RobotState.STANDING, at=2.2)
    stage.end(3.0)


def test_two_walks_beside_each_other_say_where_the_robot_was_at_the_status_and_at_the_end(
    stage: Stage, monkeypatch: pytest.MonkeyPatch
) -> None:
    walk_past(stage, at=1.5)
    other = Stage(monkeypatch)
    walk_past(other, at=2.5)
    html = lab.film_beside({"at once": stage.recording, "settled": other.recording})
    if "No film: " not in html.data:
        shown = frames(html)
        assert len(shown) == pytest.approx(3.0 * RATE, abs=1)
        assert near(shown[0], GOAL) > 30  # the goal's dot, at least in the legend
        assert near(shown[0], CAPTURE_POINT) > 30
    assert words(html) if "<img" in html.data else html.data
    for sentence in (
        "at once: SUCCEEDED after 1.5 s, 0.05 m before the goal, WALKING; in the end 0.20 m past the goal, STANDING.",
        "settled: SUCCEEDED after 2.5 s, 0.20 m past the goal, STANDING; in the end 0.20 m past the goal, STANDING.",
    ):
        assert sentence in html.data


def test_the_film_of_an_arm_says_from_where_to_where_its_joint_has_moved(stage: Stage) -> None:
    names = [*ACTUATED_JOINTS]
    for tenth in range(11):
        stage.walk(tenth / 10)
        bend = [-0.5 - tenth / 10 if name == "l_elbow" else 0.0 for name in names]
        stage.publish("joint_states", JointState(name=names, position=bend), tenth / 10)
    film = stage.end(1.0).film()
    assert "The robot for 1.0 s; l_elbow begins at -0.50 rad and ends at -1.50 rad" in film.data


def test_a_recording_without_a_goal_says_what_to_do(stage: Stage) -> None:
    stage.walk(0.5)
    stage.end(1.0)
    for film in (
        lambda: lab.film_beside({"a": stage.recording}),
        lambda: lab.film_from_above(stage.recording),
    ):
        with pytest.raises(lab.LabError, match="send it inside the `with` block"):
            film()


def travel(stage: Stage) -> HTML:
    """A trip of 2 s along x, on which the robot turns to the left, with a push."""
    goal = NavigateToPose.Goal()
    goal.pose.header.frame_id = "odom"
    goal.pose.pose.position.x = 1.0
    for twentieth in range(42):
        t = twentieth / 20
        stage.walk(t, x=0.3 * t, yaw=0.5 if t > 1.0 else 0.0)
    stage.recording.add_event(GoalSent(t=1000.0, goal="go 1", action="go", request=goal))
    stage.recording.add_event(GoalAnswered(t=1000.02, goal="go 1", accepted=True))
    for at, phase in ((0.1, "walking"), (0.5, "walking"), (1.1, "turning"), (1.5, "walking")):
        told = FeedbackReceived(t=1000.0 + at, goal="go 1", feedback=NavigateToPose.Feedback(status=phase))
        stage.recording.add_event(told)
    stage.now = 1000.0 + FLASHING - 0.2
    stage.recording.mark("push")
    stage.recording.add_event(ResultReceived(t=1001.9, goal="go 1", status=4, result=NavigateToPose.Result()))
    stage.end(2.0)
    return lab.film_from_above(stage.recording, reach=0.6, title="A trip")


def test_a_trip_from_above_shows_its_phases_and_moments(stage: Stage) -> None:
    assert words(travel(stage)) == (
        "A trip, 2.0 s. Phases: walking from 0.1 s, turning from 1.1 s, walking from 1.5 s. 1.0 s: push. "
        "In the end SUCCEEDED, 0.42 m from the goal."
    )


def test_the_phase_has_its_colour_and_the_push_flashes(stage: Stage) -> None:
    shown = frames(travel(stage))
    assert len(shown) == 25
    walking, pushed = shown[10], shown[round(FLASHING * RATE)]
    assert near(walking, BLUE) > 500  # the robot, its path and the word
    assert near(walking, VERMILION) < 20
    assert near(pushed, VERMILION) > 800  # another phase, and the ring around the robot


def test_feedback_without_a_phase_is_refused(stage: Stage) -> None:
    walk_past(stage, at=1.5)
    with pytest.raises(lab.LabError, match="its feedback has no `status`"):
        lab.film_from_above(stage.recording)


@pytest.mark.parametrize("film", ["beside", "from above", "alone"])
def test_a_film_is_announced_while_it_is_drawn(
    stage: Stage, monkeypatch: pytest.MonkeyPatch, film: str
) -> None:
    shown: list[str] = []

    class Handle:
        def update(self, content: dict[str, str], **_: object) -> None:
            shown.append(content["text/plain"])

    def display(content: dict[str, str], **_: object) -> Handle:
        shown.append(content["text/plain"])
        return Handle()

    walk_past(stage, at=1.5)
    make = {
        "beside": lambda: lab.film_beside({"a": stage.recording}),
        "from above": lambda: travel(Stage(monkeypatch)),
        "alone": lambda: stage.recording.film(),
    }[film]
    monkeypatch.setattr(lab.client.topics, "object_poses", dict)
    monkeypatch.setattr(cell_notice, "get_ipython", lambda: SimpleNamespace(kernel=True))
    monkeypatch.setattr(cell_notice, "display", display)
    monkeypatch.setattr(cell_notice, "DELAY", 0.01)
    make()
    assert [*dict.fromkeys(shown)] == [DRAWING, ""]
