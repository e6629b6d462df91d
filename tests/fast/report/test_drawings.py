"""The drawings of a failed check, from recorded events, and the submission for which they are shown."""

from __future__ import annotations

import re

from geometry_msgs.msg import PoseStamped
from std_srvs.srv import Empty

from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.classroom.pages.drawings import Drawings, drawing_into
from autograder.classroom.pages.plots import motion_svgs
from autograder.engine.verdict import CheckVerdict, Grade
from autograder.report.sequence import transcript_svg
from humanoid_interfaces.action import WalkTo
from humanoid_interfaces.msg import RobotState
from records import robot
from ros_runtime.message_constants import GoalStatus

SOURCES = {"walk_to.py": "print('a program')"}
FAILED = CheckVerdict("walks", "It walks", "failed", 0, 2, expected="1 m", observed="0 m", robot_time=3.0)


def walk(to=1.0, goal_x=1.0, scenario="walk_ahead"):
    goal = WalkTo.Goal(target_pose=PoseStamped())
    goal.target_pose.pose.position.x = goal_x
    return Transcript.from_events(
        scenario,
        {},
        [
            ev.NodeReady(t=0.0, waited=1.0),
            ev.GoalSent(t=0.5, goal="a <b>", action="walk_to", request=goal),
            ev.GoalAnswered(t=0.6, goal="a <b>", accepted=True),
            *(ev.FeedbackReceived(t=1 + k / 5, goal="a <b>", feedback=WalkTo.Feedback()) for k in range(5)),
            ev.CancelSent(t=2.0, cancel="1", goal="a <b>", by="client"),
            ev.ResultReceived(t=2.5, goal="a <b>", status=GoalStatus.CANCELED, result=WalkTo.Result()),
            *(robot(k / 10, mode=RobotState.WALKING, x=to * k / 30, speed=0.2) for k in range(31)),
        ],
    )


def said(svg):
    """The title and the words of a drawing."""
    return re.search(r"<title>(.*?)</title>\n<desc>(.*?)</desc>", svg, re.DOTALL).groups()


def test_a_walk_has_its_speed_with_the_goals_moments_and_its_path_with_the_goals_place():
    speed, path = (said(svg) for svg in motion_svgs(walk(), "walk ahead"))
    assert speed == (
        "Speed of the robot: walk ahead",
        "speed, m/s: 0.20 at first, 0.20 at last, 0.20 at most; time, s: 0.00 to 3.00. "
        "goal “a &lt;b&gt;”: at 0.50. cancel “a &lt;b&gt;”: at 2.00. “a &lt;b&gt;” ends CANCELED: at 2.50. "
        "5 feedback messages from 1.00 to 1.80.",
    )
    assert "start: at 0.00, 0.00. goal “a &lt;b&gt;”: at 1.00, 0.00. end: at 1.00, 0.00." in path[1]


def test_a_standing_robot_has_no_plot_and_an_invalid_goal_no_position():
    assert motion_svgs(walk(to=0.01), "stay") == []
    for nowhere in (float("nan"), float("inf"), 1e6):
        assert "goal" not in said(motion_svgs(walk(goal_x=nowhere), "walk")[1])[1]


def test_a_failed_check_has_its_drawings_under_its_own_submission_and_verdict_only(tmp_path):
    grade = Grade("walk_to", "anna", "namespaces", [FAILED])
    drawn = {}
    drawing_into(drawn)(FAILED, [walk()])
    Drawings(tmp_path).keep_all(grade, SOURCES, drawn)
    kept = Drawings(tmp_path).of(grade, SOURCES)
    assert [said(svg)[0] for svg in kept["walks"]] == [
        "walk ahead",
        "Speed of the robot: walk ahead",
        "Path of the robot, from above: walk ahead",
    ]
    later = CheckVerdict(**(vars(FAILED) | {"observed": "0.5 m"}))
    assert Drawings(tmp_path).of(Grade("walk_to", "anna", "namespaces", [later]), SOURCES) == {}
    assert Drawings(tmp_path).of(grade, {"walk_to.py": "another program"}) == {}
    assert Drawings(tmp_path).of(grade, None) == {}


def test_passed_checks_are_not_drawn_and_a_failed_drawing_costs_no_grade(caplog):
    drawn = {}
    judged = drawing_into(drawn)
    judged(CheckVerdict("walks", "It walks", "passed", 2, 2), [walk()])
    nothing_to_draw = Transcript.from_events("walk", {}, [ev.ScenarioEnded(t=1.0)])
    judged(FAILED, [nothing_to_draw])
    assert drawn == {}
    assert "no drawing of walks" in caplog.text


def test_a_plot_has_the_same_bytes_each_time_and_shows_any_text_as_it_is():
    first, second = (motion_svgs(walk(scenario="$x$ <b>"), "$\\frac{ <b>") for _ in range(2))
    assert first == second
    assert "$\\frac{ &lt;b&gt;" in first[0]


def test_requests_that_end_with_the_program_are_one_line() -> None:
    waits = (1.5, 0.0, 0.0)
    calls = [
        ev.ServiceCalled(t=1.0, call=f"ask {n}", service="ask", request=Empty.Request()) for n in range(3)
    ]
    ends = [
        ev.Unanswered(t=2.5 + wait / 100, what="call", id=f"ask {n}", waited=wait)
        for n, wait in enumerate(waits)
    ]
    drawn = transcript_svg(Transcript.from_events("in_order", {}, [*calls, *ends]), "in order")
    assert drawn.count(">ask?</text>") == 3
    assert drawn.count(">no answer to 3 calls after 1.5 s</text>") == drawn.count(">no answer") == 1
