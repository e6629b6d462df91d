"""Judges what became of the cup when a goal was cancelled, gave way to another, or could not be carried out."""

from __future__ import annotations

from collections.abc import Sequence

from autograder.authoring import events as ev
from autograder.authoring.failure import expect
from autograder.authoring.falls import require_fell_told, require_knocked_over
from autograder.authoring.goal import ABORTED, Goal
from autograder.authoring.missing import Missing
from autograder.authoring.robot_record import RobotRecord
from autograder.authoring.walking.reports import require_error_code

from .endings import require_aborted, require_robot_upright
from .holding import require_held_when
from .placing import require_placed, require_put_down, require_standing
from .truth import (
    grip_at,
    grips,
    reports,
    taken_from,
)

FELL_OVER = 0.8
MOVED = 0.05  # rad
OPENED_BY = 0.01  # m


def require_nothing_moved(goal: Goal) -> None:
    """Require that arm, waist and fingers stayed where they were from the goal's arrival to the end of the scenario.

    Until the result would not do: an arm that was told to move takes longer to begin than a server to abort.
    """
    run, start, end = goal.run, goal.sent.t, goal.run.end
    joints = reports(run, ev.JointsTruth, start, end)
    for report in joints:
        joint, moved = max(
            ((name, abs(place - joints[0].positions[name])) for name, place in report.positions.items()),
            key=lambda pair: pair[1],
        )
        expect(
            moved <= MOVED,
            expected="an arm that stays where it is until the goal is known to be possible",
            observed=f"{joint} moved by {moved:.2f} rad",
            help="Ask compute_arm_ik for the grasp and for the place first; publish on joint_trajectory afterwards.",
            at=report.t,
        )
    seen = grips(run, start, end)
    moved, worst = max(
        ((abs(grip.opening - seen[0].opening), grip) for grip in seen), key=lambda pair: pair[0]
    )
    expect(
        moved <= OPENED_BY,
        expected="a hand that stays as it is until the goal is known to be possible",
        observed=f"it opened or closed by {moved:.3f} m",
        help="Open the hand after compute_arm_ik has found both places, not before.",
        at=worst.t,
    )


def require_preempted_or_rejected(first: Goal, second: Goal) -> None:
    """Require that of two goals only one had the hand: the second was rejected, or took it after a safe end."""
    first.require_accepted()
    require_held_when(first, second.sent.t)
    if second.answer is not None and not second.answer.accepted:
        require_placed(first)
        return
    second.require_accepted()
    end = first.require_result(
        ABORTED,
        help="Two goals had one hand. Reject the second one in goal_callback, or end the first one with PREEMPTED.",
    )
    require_error_code(first, "PREEMPTED", because="a later goal has the hand")
    first.require_reason()
    expect(
        end.t >= second.sent.t,
        expected="the first goal to go on until the second one comes",
        observed=f"it ended {second.sent.t - end.t:.1f} s before",
        help="Abort with PREEMPTED only when another goal has been accepted.",
        at=end.t,
    )
    require_placed(second)
    _require_never_fallen(second)


def _require_never_fallen(goal: Goal) -> None:
    tilted = min(reports(goal.run, ev.ObjectTruth, goal.sent.t, goal.run.end), key=lambda cup: cup.up)
    expect(
        tilted.up >= FELL_OVER,
        expected="a cup that stays upright while one goal gives way to another",
        observed="it fell over",
        help="Put down what is held, open, withdraw, and only then let the other goal begin.",
        at=tilted.t,
    )


def require_put_away(goal: Goal, place: Sequence[float], name: str) -> None:
    """Require that a goal, cancelled while the cup hung in the hand, ended CANCELED with the cup at a place."""
    request = goal.require_canceled()
    require_held_when(goal, request.t)
    assert goal.result
    require_standing(
        goal,
        place,
        goal.result.t,
        name,
        lesson="When the cancel comes, compare how far the cup is from where it stood and from place_pose, in x and y; "
        "carry it to the nearer one, put it down, open, withdraw, then call canceled().",
    )
    require_put_down(goal)
    require_robot_upright(goal.run, goal.accepted_at, goal.result.t)


def require_left_alone(goal: Goal) -> None:
    """Require that a goal cancelled before the grasp ended CANCELED, with the cup where it was and the hand off it."""
    request = goal.require_canceled()
    grip = grip_at(goal.run, request.t)
    expect(
        grip.distance <= 0.2,
        expected="the hand near the cup by then",
        observed=f"it is {grip.distance:.2f} m away",
        help="Bring the hand to the cup: approach it as soon as the goal executes.",
        at=request.t,
    )
    assert goal.result
    require_standing(
        goal,
        taken_from(goal),
        goal.result.t,
        "where it stood",
        lesson="Nothing is held yet: open the hand and draw it straight back, away from the cup, then call canceled().",
    )
    require_robot_upright(goal.run, goal.accepted_at, goal.result.t)


def require_grasp_failed(goal: Goal) -> ev.ResultReceived:
    """Require that a goal whose cup was taken away was ABORTED with GRASP_FAILED."""
    goal.require_accepted()
    taken = _taken(goal.run)
    result = require_aborted(
        goal,
        "GRASP_FAILED",
        because="nothing was between the fingers",
        help="The fingers closed on nothing, and the goal went on. After closing, r_gripper/wrench has to say at least "
        "1 N.",
    )
    expect(
        result.t >= taken,
        expected="the goal to go on until the hand has closed on nothing",
        observed=f"it ended {taken - result.t:.1f} s before the cup was taken away",
        help="Close the hand, wait, and look at the force then.",
        at=result.t,
    )
    return result


def require_dropped(goal: Goal) -> ev.ResultReceived:
    """Require that a goal whose cup was snatched out of the hand was ABORTED with DROPPED, soon."""
    goal.require_accepted()
    taken = _taken(goal.run)
    require_held_when(goal, taken)
    result = require_aborted(
        goal,
        "DROPPED",
        because="the force vanished on the way",
        help="The cup was gone and the goal went on. While you hold it, look at r_gripper/wrench in every round.",
    )
    expect(
        result.t >= taken,
        expected="the goal to go on while the cup hangs in the hand",
        observed=f"it ended {taken - result.t:.1f} s before the cup was lost",
        help="Compare the measured force with 1 N, not with grasp_force.",
        at=result.t,
    )
    return result


def _taken(run: RobotRecord) -> float:
    """Return when (s) the scenario took the cup away, for which hand and cup must have been as it waits for."""
    if run.one(ev.Mark, "name", "taken") is None:
        raise Missing(
            run, expected="a hand that gets as far as the cup", never="the cup was never taken away from it"
        )
    return run.told("move_object", name="cup").t


def require_aborted_by_a_fall(goal: Goal) -> None:
    """Require that a goal was ABORTED with FELL when the robot had been knocked over, and not before."""
    goal.require_accepted()
    require_fell_told(goal, require_knocked_over(goal.run))
