"""A goal that goes wrong is explained by its status, its feedback and the robot."""

from __future__ import annotations

from typing import Any

import pytest

from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.goal import ABORTED, CANCELED, SUCCEEDED
from autograder.authoring.walking import truth as walking_truth
from humanoid_interfaces.action import WalkTo
from records import SPINNING, failure_of, given_up, robot, run_of, said, stack
from ros_runtime.message_constants import GoalStatus

IN_EXECUTE = '  File "/tmp/work/walk.py", line 97, in execute'


def goal_run(*events: Any, accepted: bool = True) -> Any:
    sent = ev.GoalSent(t=2.0, goal="walk", action="walk_to", request=WalkTo.Goal())
    answer = ev.GoalAnswered(t=2.1, goal="walk", accepted=accepted)
    return run_of(sent, answer, *events).goal("walk")


def status(value: int, t: float = 2.2) -> Any:
    return ev.StatusSeen(t=t, goal="walk", status=value)


def feedback(t: float, distance: float = 0.31) -> Any:
    return ev.FeedbackReceived(t=t, goal="walk", feedback=WalkTo.Feedback(distance_remaining=distance))


def result(value: int, t: float = 4.0) -> Any:
    return ev.ResultReceived(t=t, goal="walk", status=value, result=WalkTo.Result())


NO_RESULT = given_up("result", "walk", t=12.0)


@pytest.mark.parametrize(
    ("events", "next_step"),
    [
        (
            [status(GoalStatus.EXECUTING), feedback(11.8)],
            "execute is still in its loop, 0.31 m from the goal. Check the condition that ends the loop.",
        ),
        (
            [status(GoalStatus.EXECUTING), feedback(2.3), feedback(11.8, distance=1.9)],
            "1.90 m from the goal. The robot moves away from the goal: cmd_vel is in base_link's axes",
        ),
        (
            [status(GoalStatus.CANCELING), feedback(11.8)],
            "The cancel was accepted: check goal_handle.is_cancel",
        ),
        ([status(GoalStatus.ACCEPTED)], "a handle_accepted_callback must call goal_handle.execute()"),
        (
            [status(GoalStatus.SUCCEEDED), stack(*SPINNING)],
            "No callback of your node runs any more: a spin inside",
        ),
        (
            [status(GoalStatus.SUCCEEDED), stack('"/tmp/work/walk.py", line 9 in execute')],
            "execute made its terminal call but has not returned",
        ),
        (
            [status(GoalStatus.EXECUTING), feedback(11.8), status(GoalStatus.SUCCEEDED, t=13.5)],
            "It takes too long",
        ),
        (
            [
                status(GoalStatus.EXECUTING),
                *(feedback(2.5 + second) for second in range(10)),
                *(robot(float(second), x=0.1 * second) for second in range(20)),
            ],
            "distance_remaining stayed 0.31 m in all 10 feedback messages: the callback of odom never runs",
        ),
        ([status(GoalStatus.SUCCEEDED)], "execute returned no result: its last line must be `return result`"),
        (
            [status(GoalStatus.EXECUTING), feedback(3.0), stack('"/tmp/work/walk.py", line 9 in execute')],
            "something in it waits without a timeout. It was blocked in line 9 of walk.py, in execute().",
        ),
    ],
)
def test_a_goal_without_a_result_is_explained_by_its_status_and_feedback(
    events: list[Any], next_step: str
) -> None:
    failure = failure_of(goal_run(*events, NO_RESULT).require_result, SUCCEEDED)
    assert next_step in failure.help
    assert "make one terminal call" not in failure.help


RAISED = said("[ERROR] [walk]: Error raised in execute callback: no odom", IN_EXECUTE)
FORBIDDEN = said(
    "Error raised in execute callback: attempted invalid transition from state EXECUTING with event CANCELED",
    IN_EXECUTE,
)


@pytest.mark.parametrize(
    ("lines", "next_step"),
    [
        (RAISED, "execute raised an exception in line 97 of walk.py, in execute(): no odom."),
        (
            FORBIDDEN,
            "execute called goal_handle.canceled() in line 97 of walk.py, in execute(), but no cancel of this "
            "goal was requested",
        ),
        (
            said("Goal state not set, assuming aborted. Goal ID: 1"),
            "execute returned without a terminal call",
        ),
        ([], "execute called goal_handle.abort(): check the condition before this call."),
    ],
)
def test_for_an_aborted_goal_the_cause_is_named(lines: list[Any], next_step: str) -> None:
    failure = failure_of(goal_run(*lines, result(ABORTED)).require_result, SUCCEEDED)
    assert failure.help.startswith(next_step)


def test_for_a_rejected_second_goal_the_end_of_the_first_is_reported() -> None:
    run = run_of(
        ev.GoalSent(t=2.0, goal="walk", action="walk_to", request=WalkTo.Goal()),
        ev.GoalAnswered(t=2.1, goal="walk", accepted=True),
        result(SUCCEEDED),
        ev.GoalSent(t=6.0, goal="again", action="walk_to", request=WalkTo.Goal()),
        ev.GoalAnswered(t=6.1, goal="again", accepted=False),
    )
    failure = failure_of(walking_truth.require_accepted, run.goal("again"))
    assert "clear your flag that the robot is busy" in failure.help


def test_a_check_says_itself_what_a_goal_that_went_on_has_missed() -> None:
    on = goal_run(status(GoalStatus.EXECUTING), feedback(11.8), NO_RESULT)
    assert failure_of(on.require_result, ABORTED, "It fell.").help == "It fell."
    assert failure_of(goal_run(result(SUCCEEDED)).require_result, ABORTED, "It fell.").help == "It fell."
    canceled = goal_run(result(CANCELED)).require_result
    assert "goal_handle.abort()" in failure_of(canceled, ABORTED, "It fell.").help


def test_a_goal_with_another_final_status_and_no_result_is_reported_by_that_status() -> None:
    arrived = goal_run(status(GoalStatus.SUCCEEDED), NO_RESULT)
    failure = failure_of(arrived.require_result, ABORTED, "The old goal went on.")
    assert (failure.expected, failure.observed) == ("status ABORTED", "status SUCCEEDED")
    assert failure.help == "The old goal went on."


def test_a_cancel_after_an_early_end_is_about_that_end() -> None:
    events = [
        *RAISED,
        result(ABORTED),
        ev.CancelSent(t=6.0, cancel="1", goal="walk", by="client"),
        ev.CancelAnswered(t=6.1, cancel="1", return_code=3, canceling=[]),
    ]
    failure = failure_of(goal_run(*events).require_canceled)
    assert failure.observed == "it had ended ABORTED at 4.0 s"
    assert "execute raised an exception" in failure.help


def test_a_goal_callback_that_raises_is_advised_to_reject() -> None:
    sent = ev.GoalSent(t=2.0, goal="walk", action="walk_to", request=WalkTo.Goal())
    goal = run_of(sent, *said("ValueError: no"), ev.NodeExited(t=3.1, returncode=1)).goal("walk")
    assert "return GoalResponse.REJECT instead" in failure_of(goal.require_rejected, because="", help="").help


@pytest.mark.parametrize(
    ("x", "claimed", "next_step"),
    [
        (0.05, 0.05, "The position is right, the heading is 0.50 rad off"),
        (0.30, 0.31, "Your own feedback reported 0.31 m left, and then you called succeed()"),
        (0.90, 0.05, "Your feedback reported 0.05 m left: measure from odom's pose to the goal"),
        (0.90, None, "Compare odom with the goal's pose"),
    ],
)
def test_for_a_robot_that_has_not_arrived_the_cause_is_named(
    x: float, claimed: float | None, next_step: str
) -> None:
    sent = ev.GoalSent(t=2.0, goal="walk", action="walk_to", request=WalkTo.Goal())
    sent.request.target_pose.pose.orientation.w = 1.0
    came = [] if claimed is None else [WalkTo.Feedback(distance_remaining=claimed)]
    events = [
        sent,
        ev.GoalAnswered(t=2.1, goal="walk", accepted=True),
        *(ev.FeedbackReceived(t=3.9, goal="walk", feedback=message) for message in came),
        result(SUCCEEDED),
        *(robot(tenth / 10, x=x, yaw=0.5) for tenth in range(100)),
    ]
    walk = walking_truth
    assert failure_of(walk.require_arrival, run_of(*events).goal("walk")).help.startswith(next_step)
