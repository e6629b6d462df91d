"""The failures of a server that stands the robot up by the clock, too soon, or against a force."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from action_msgs.msg import GoalStatus

from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.engine.exercise import exercise_module
from humanoid_interfaces.action import StandUp
from humanoid_interfaces.msg import RobotState
from records import failure_of, robot, run_of

MODEL = exercise_module("stand_up", "model")
ACCEPTED, LEAN, LET_GO = 2.0, 1.5, 5.0  # s
EVEN, UNEVEN = (186.0, 186.0), (300.0, 72.0)  # N
ABORTED, SUCCEEDED = GoalStatus.STATUS_ABORTED, GoalStatus.STATUS_SUCCEEDED


def risen(at: float) -> Callable[[float], float]:
    """The height over time of a pelvis that has risen at a time (s), after a motion of one second."""
    return lambda t: 0.45 + 0.15 * max(0.0, min(1.0, t - at + 1.0))


def stood_up(
    height: Callable[[float], float],
    *more: Any,
    end: float = 4.5,
    status: int = SUCCEEDED,
    feedback: list[tuple[float, str, float]] | None = None,
    until: float = 18.0,
    **result: Any,
) -> Transcript:
    """A run whose pelvis was at height(t), with feedback (s, phase, percent) and a result at `end` (s)."""
    told = [
        ev.FeedbackReceived(
            t=t, goal="rise", feedback=StandUp.Feedback(phase=phase, percent_complete=percent)
        )
        for t, phase, percent in feedback or []
    ]
    return run_of(
        *(robot(0.02 * k, z=height(0.02 * k)) for k in range(int(until / 0.02))),
        ev.GoalSent(t=ACCEPTED - 0.1, goal="rise", action="stand_up", request=StandUp.Goal()),
        ev.GoalAnswered(t=ACCEPTED, goal="rise", accepted=True),
        *told,
        *more,
        ev.ResultReceived(t=end, goal="rise", status=status, result=StandUp.Result(**result)),
        until=until,
    )


def leaned_on(begin: float = LEAN, end: float = LET_GO) -> list[Any]:
    """A force acts on the robot between two times (s)."""
    command = {"do": "push", "impulse": [0.0, 70.0, 0.0], "duration": end - begin}
    loads = [(0.02 * k, UNEVEN if begin < 0.02 * k < end else EVEN) for k in range(500)]
    feet = [ev.FeetTruth(t=t, left=left, right=right) for t, (left, right) in loads]
    return [ev.RobotCommanded(t=begin, command=command), *feet]


PHASES = [(2.2, "shifting", 0.0), (2.7, "rising", 35.0), (3.0, "rising", 80.0), (3.4, "settling", 99.0)]


def test_a_measured_rise_passes() -> None:
    run = stood_up(risen(3.2), feedback=[*PHASES, (4.4, "settling", 100.0)])
    for obligation in (
        *(MODEL.accepts, MODEL.succeeds, MODEL.rises_in_place, MODEL.settles, MODEL.names_no_error),
        *(MODEL.names_its_phase, MODEL.measures_percent, MODEL.never_loses_percent),
    ):
        assert obligation.judge(run)


def test_a_success_in_the_crouch_names_what_raises_the_pelvis() -> None:
    failure = failure_of(MODEL.succeeds.judge, stood_up(lambda t: 0.45))
    assert "0.450 m" in failure.observed
    assert failure.help.startswith("The robot never rose: publish a Twist with linear.z")


def test_a_success_on_the_way_has_not_settled() -> None:
    assert "at 0.5" in failure_of(MODEL.settles.judge, stood_up(risen(4.5))).observed


@pytest.mark.parametrize(
    ("phases", "word"),
    [
        (
            [(2.2, "rising", 0.0), (3.4, "settling", 99.0), (3.6, "rising", 99.0)],
            "'rising', 'settling', 'rising'",
        ),
        ([(2.7, "going up", 30.0)], "'going up'"),
        (
            [(2.2, "shifting", 0.0), (2.5, "rising", 10.0), (2.8, "settling", 90.0)],
            "'settling' while it moved up, at 0.5",
        ),
    ],
)
def test_phases_that_follow_the_clock_are_detected(phases: list[tuple[float, str, float]], word: str) -> None:
    failure = failure_of(MODEL.names_its_phase.judge, stood_up(risen(3.2), feedback=phases))
    assert word in failure.observed


@pytest.mark.parametrize("percent", [75.0, 0.4])
def test_a_percentage_that_is_not_the_share_of_the_height_is_detected(percent: float) -> None:
    run = stood_up(risen(3.2), feedback=[(2.1, "shifting", percent), (4.0, "settling", percent)])
    assert "by that share of its way" in failure_of(MODEL.measures_percent.judge, run).expected


def test_the_percentage_may_decrease_only_in_phase_shifting() -> None:
    back = [(2.7, "rising", 35.0), (3.0, "shifting", 20.0)]
    assert MODEL.never_loses_percent.judge(stood_up(risen(4.0), feedback=back))
    bobs = stood_up(risen(4.0), feedback=[back[0], (3.0, "rising", 20.0)])
    assert "20.0 after 35.0" in failure_of(MODEL.never_loses_percent.judge, bobs).observed


def test_a_rise_under_somebodys_weight_is_shown_the_loads() -> None:
    shifting = [(t, "shifting", 0.0) for t in (2.4, 2.6, 4.0)]
    waits = stood_up(risen(6.4), *leaned_on(), end=8.0, feedback=shifting)
    assert MODEL.stays_down_while_uneven.judge(waits)
    assert MODEL.names_shifting.judge(waits)
    rises = stood_up(risen(3.5), *leaned_on(), end=8.0, feedback=shifting)
    failure = failure_of(MODEL.stays_down_while_uneven.judge, rises)
    assert "loads of 300 and 72 N" in failure.observed
    assert "force.z" in failure.help


def test_without_a_force_on_the_robot_the_check_does_not_pass() -> None:
    even = [ev.FeetTruth(t=0.02 * k, left=186.0, right=186.0) for k in range(500)]
    assert not MODEL.stays_down_while_uneven.judge(stood_up(risen(6.4), *even, end=8.0))
    assert not MODEL.stays_down_while_uneven.judge(stood_up(risen(6.4), end=8.0))


def test_a_rise_that_goes_on_when_it_is_leaned_on_is_found_and_so_is_its_phase() -> None:
    def stops(t: float) -> float:
        return risen(3.2)(min(t, 2.6)) if t < LET_GO else risen(6.4)(max(t, 5.9))

    leaned = leaned_on(2.4, LET_GO)
    shifting = [(2.3, "rising", 5.0), (3.1, "shifting", 25.0), (4.0, "shifting", 25.0)]
    stopped = stood_up(stops, *leaned, end=8.0, feedback=shifting)
    assert MODEL.shifts_again.judge(stopped)
    assert MODEL.names_shifting.judge(stopped)
    named = stood_up(stops, *leaned, end=8.0, feedback=[(t, "rising", percent) for t, _, percent in shifting])
    assert "'rising'" in failure_of(MODEL.names_shifting.judge, named).observed
    goes_on = stood_up(risen(3.2), *leaned, end=8.0, feedback=shifting)
    assert "to stop" in failure_of(MODEL.shifts_again.judge, goes_on).expected


def test_a_goal_for_a_standing_robot_needs_the_code_and_a_message() -> None:
    def ended(**result: Any) -> Transcript:
        return stood_up(lambda t: 0.60, end=2.4, **result)

    code = {"error_code": StandUp.Result.ALREADY_STANDING}
    assert MODEL.says_that_it_stands.judge(ended(status=ABORTED, **code, error_msg="it stands"))
    assert "has not succeeded" in failure_of(MODEL.says_that_it_stands.judge, ended()).help
    assert "empty" in failure_of(MODEL.says_why_it_aborted.judge, ended(status=ABORTED, **code)).observed
    without = ended(status=ABORTED, error_msg="it stands")
    assert "ALREADY_STANDING" in failure_of(MODEL.says_that_it_stands.judge, without).expected


@pytest.mark.parametrize(("end", "word"), [(9.0, "ABORTED after 7.0 s"), (17.5, "ABORTED after 15.5 s")])
def test_the_time_limit_is_neither_early_nor_late(end: float, word: str) -> None:
    run = stood_up(lambda t: 0.45, end=end, status=ABORTED, error_msg="too long")
    assert failure_of(MODEL.keeps_the_limit.judge, run).observed == word


def test_a_success_after_the_time_limit_comes_too_late() -> None:
    failure = failure_of(MODEL.keeps_the_limit.judge, stood_up(risen(16.5), end=17.5))
    assert "ABORTED" in failure.expected
    assert failure.help.startswith("12 s after acceptance")


def test_no_answer_for_a_fallen_robot_is_not_a_rejection() -> None:
    lying = [robot(0.02 * k, mode=RobotState.FALLEN) for k in range(500)]
    asked = ev.GoalSent(t=ACCEPTED, goal="lying", action="stand_up", request=StandUp.Goal())
    failure = failure_of(MODEL.refuses_the_floor.judge, run_of(*lying, asked, until=10.0))
    assert "no answer" in failure.observed


def test_the_time_limit_has_no_code() -> None:
    def gave_up(**result: Any) -> Transcript:
        return stood_up(lambda t: 0.45, end=14.1, status=ABORTED, error_msg="too long", **result)

    assert MODEL.names_no_error.judge(gave_up())
    assert "NONE" in failure_of(MODEL.names_no_error.judge, gave_up(error_code=StandUp.Result.FELL)).expected


@pytest.mark.parametrize(
    ("later", "help"),
    [(0.60, "Publish a zero Twist before you end the goal"), (0.45, "Do not make the robot crouch again")],
)
def test_a_cancel_leaves_the_pelvis_where_it_is(later: float, help: str) -> None:
    def stays(height: float) -> Transcript:
        cancel = [
            ev.CancelSent(t=2.6, cancel="cancel 1", goal="rise", by="client"),
            ev.CancelAnswered(t=2.7, cancel="cancel 1", return_code=0, canceling=["rise"]),
        ]
        status = GoalStatus.STATUS_CANCELED
        return stood_up(lambda t: risen(3.2)(t) if t < 2.65 else height, *cancel, end=3.0, status=status)

    assert MODEL.stays_where_it_ended.judge(stays(0.53))
    assert failure_of(MODEL.stays_where_it_ended.judge, stays(later)).help.startswith(help)


@pytest.mark.parametrize(
    ("result", "end", "word"),
    [
        (
            {"error_code": StandUp.Result.ALREADY_STANDING, "error_msg": "it stands"},
            2.1,
            "compare odom's height",
        ),
        (
            {"error_code": StandUp.Result.FELL, "error_msg": "it fell"},
            4.0,
            "had not fallen, only been pushed",
        ),
        ({"error_msg": "too long"}, 14.1, "with the pelvis at 0.45 m"),
        ({"error_msg": "somebody pushes"}, 4.0, "The robot could have risen"),
    ],
)
def test_an_abort_is_explained_by_its_code_and_its_time(
    result: dict[str, Any], end: float, word: str
) -> None:
    failure = failure_of(MODEL.succeeds.judge, stood_up(lambda t: 0.45, end=end, status=ABORTED, **result))
    assert word in failure.help
    assert repr(result["error_msg"]) in failure.observed


def test_an_execute_callback_that_blocks_odom_is_detected() -> None:
    told = [(2.2 + 0.2 * k, "rising", 0.0) for k in range(12)]
    run = stood_up(risen(3.2), end=14.1, status=ABORTED, error_msg="too long", feedback=told)
    assert "percent_complete stayed 0 in all 12" in failure_of(MODEL.succeeds.judge, run).help
