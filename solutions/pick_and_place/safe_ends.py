"""How a goal ends safely when it is cancelled, preempted, or cannot be carried out."""

from __future__ import annotations

import re

from autograder.authoring import ABORTED, Goal, ev, expect, require_fall_reported, require_knocked_over
from autograder.authoring.walking.life import accepted, successors, was_not_awaited
from autograder.authoring.walking.reports import require_error_code

from . import life
from .endings import require_aborted
from .holding import require_held_when
from .placing import OPENED, TIMEOUT_SLACK, require_standing, require_withdrawn
from .truth import carried, grip_at, grips, place_of, reports, taken_from

MIN_UPRIGHT = 0.8  # vertical component of the cup's axis, a unit vector; less means that it has fallen over
MAX_JOINT_MOTION = 0.05  # rad
MAX_OPENING_CHANGE = 0.01  # m
EARLIEST_UNKNOWN, LATEST_UNKNOWN = 0.8, 2.5  # s after acceptance, between which UNKNOWN_OBJECT must come
GRASP_TIMEOUT = 20.0  # s for a hand that does not arrive
NEAR_THE_CUP = 0.2  # m
BEFORE_LOSS = 0.1  # s
ALIKE = 0.03  # m; distances that differ by less count as equal


# -- goals that cannot be carried out ---------------------------------------------------------------------------------


def knows_what_is_unknown(goal: Goal) -> str | None:
    """If nothing is published on objects/<object_id>/pose for 1 s, the goal ends with UNKNOWN_OBJECT."""
    name = goal.request.object_id
    if not accepted(goal) or goal.request.object_id == life.CUP:
        return None
    is_a_name = re.fullmatch(r"[A-Za-z_]\w*", name, re.ASCII) is not None
    result = require_aborted(
        goal,
        "UNKNOWN_OBJECT",
        because=f"nothing is published on objects/{name}/pose"
        if is_a_name
        else f"there is no object {name!r}",
        help="Wait at most 1 s for the first message on objects/<object_id>/pose, then abort."
        if is_a_name
        else "create_subscription() raises InvalidTopicNameException for an invalid name, for example with a space in "
        "it: catch it, and abort with UNKNOWN_OBJECT.",
    )
    took = result.t - goal.accepted_at
    expect(
        (EARLIEST_UNKNOWN if is_a_name else 0.0) <= took <= LATEST_UNKNOWN,
        expected="the goal ABORTED after 1 s without a message, and within 2 s of its acceptance",
        observed=f"ABORTED after {took:.1f} s",
        help="Wait 1 s for a message: poses are published 10 times a second, but discovering the publisher takes time.",
        at=result.t,
    )
    return "unknown" if is_a_name else "no name"


def refuses_what_is_out_of_reach(goal: Goal) -> str | None:
    """If the cup or the place is out of reach, the goal ends with UNREACHABLE before arm or hand move."""
    if not life.ends_by_itself(goal) or was_not_awaited(goal):
        return None
    if not life.is_for_the_cup(goal) or not life.is_far(goal):
        return None
    require_aborted(
        goal,
        "UNREACHABLE",
        because="the cup or its place is beyond the arm's reach",
        help="Before you move anything, call compute_arm_ik for the grasp and for the place; abort unless error_code "
        "is SUCCESS in both responses.",
    )
    _require_nothing_moved(goal)
    return "out of reach"


def _require_nothing_moved(goal: Goal) -> None:
    """Require that arm, waist and fingers did not move from when the goal was sent to the end of the scenario.

    Checking only until the result would miss motion, as an arm starts to move later than a server can abort.
    """
    run, start, end = goal.run, goal.sent.t, goal.run.end
    joints = reports(run, ev.JointsTruth, start, end)
    for report in joints:
        joint, moved = max(
            ((name, abs(place - joints[0].positions[name])) for name, place in report.positions.items()),
            key=lambda pair: pair[1],
        )
        expect(
            moved <= MAX_JOINT_MOTION,
            expected="an arm that does not move, as the goal is out of reach",
            observed=f"{joint} moved by {moved:.2f} rad",
            help="Call compute_arm_ik for the grasp and for the place first; publish on joint_trajectory afterwards.",
            at=report.t,
        )
    seen = grips(run, start, end)
    worst = max(seen, key=lambda grip: abs(grip.opening - seen[0].opening))
    moved = abs(worst.opening - seen[0].opening)
    expect(
        moved <= MAX_OPENING_CHANGE,
        expected="a hand that neither opens nor closes, as the goal is out of reach",
        observed=f"it opened or closed by {moved:.3f} m",
        help="Open the hand after compute_arm_ik has found both places, not before.",
        at=worst.t,
    )


# -- goals that fail on the way ---------------------------------------------------------------------------------------


def notices_what_it_does_not_hold(goal: Goal) -> str | None:
    """When the fingers close on nothing, the goal ends with GRASP_FAILED."""
    taken = _robbed_of_its_grasp(goal)
    if taken is None:
        return None
    result = require_aborted(
        goal,
        "GRASP_FAILED",
        because="nothing was between the fingers",
        help="The fingers closed on nothing, but the goal went on. After closing, require force.y of at least 1 N in "
        "r_gripper/wrench.",
    )
    _require_later(
        result, taken, "the cup was taken away", "Close the hand, wait, and only then compare the force."
    )
    return "taken away"


def withdraws_what_is_empty(goal: Goal) -> str | None:
    """After GRASP_FAILED the hand is open and withdrawn."""
    if _robbed_of_its_grasp(goal) is None or goal.result is None:
        return None
    require_withdrawn(goal, goal.result.t, taken_from(goal), opened=OPENED)
    return "taken away"


def notices_what_it_loses(goal: Goal) -> str | None:
    """When the cup is lost while it is lifted or moved, the goal ends with DROPPED."""
    taken = life.robbed_at(goal) if life.ends_by_itself(goal) and not was_not_awaited(goal) else None
    if taken is None or not carried(goal, taken):
        return None
    require_held_when(goal, taken)
    result = require_aborted(
        goal,
        "DROPPED",
        because="the cup was taken out of the hand",
        help="The hand had lost the cup, but the goal went on. While you hold the cup, check force.y of "
        "r_gripper/wrench in every round.",
    )
    _require_later(
        result, taken, "the cup was lost", "Compare the measured force with 1 N, not with grasp_force."
    )
    return f"nearer to {life.nearer_place(goal, taken - BEFORE_LOSS, 0.0)}"


def gives_up_in_time(goal: Goal) -> str | None:
    """If the hand cannot reach the cup, the goal ends with GRASP_FAILED within 20 s."""
    held = life.commanded(goal, "hold_joint") if life.ends_by_itself(goal) else None
    if held is None:
        return None
    result = require_aborted(
        goal,
        "GRASP_FAILED",
        because="the elbow was blocked, so the hand could not reach the cup",
        help="A loop waits for the hand without a timeout. Give each stage a timeout.",
    )
    expect(
        result.t - held <= GRASP_TIMEOUT + TIMEOUT_SLACK,
        expected=f"the goal ABORTED within {GRASP_TIMEOUT:.0f} s",
        observed=f"ABORTED after {result.t - held:.0f} s",
        help="Set the timeout of each stage to the duration of its trajectory plus a few seconds.",
        at=result.t,
    )
    return "blocked"


def tells_a_fall(goal: Goal) -> str | None:
    """When the robot falls, the goal is ABORTED with FELL."""
    if not life.ends_by_itself(goal) or life.commanded(goal, "push") is None:
        return None
    require_fall_reported(goal, require_knocked_over(goal.run))
    return "pushed"


# -- goals that are cancelled or preempted ----------------------------------------------------------------------------


def leaves_the_cup(goal: Goal) -> str | None:
    """A cancel before the hand grasps the cup ends CANCELED, with the hand withdrawn and the cup where it was."""
    asked = life.canceled_at(goal)
    if asked is None or not life.is_possible(goal) or carried(goal, asked):
        return None
    goal.require_canceled(goal.requests_to_cancel[0])
    grip = grip_at(goal.run, asked)
    expect(
        grip.distance <= NEAR_THE_CUP,
        expected="the hand near the cup when the cancel comes",
        observed=f"the hand was {grip.distance:.2f} m away",
        help="Move the hand to the cup as soon as the goal executes.",
        at=asked,
    )
    assert goal.result
    require_standing(
        goal,
        taken_from(goal),
        "where it stood",
        "The hand holds nothing yet: open it, move it straight back, away from the cup, then call canceled().",
    )
    return "closing" if grip.force > 0.0 else "approaching"


def puts_away(goal: Goal) -> str | None:
    """After a cancel while it holds the cup, it puts it down where it stood or at place_pose, whichever is nearer."""
    asked = life.canceled_at(goal)
    if asked is None or not life.is_possible(goal) or not life.holds_at(goal, asked):
        return None
    goal.require_canceled(goal.requests_to_cancel[0])
    assert goal.result
    nearer = life.nearer_place(goal, asked, ALIKE) or life.nearer_place(goal, goal.result.t, 0.0)
    require_standing(
        goal,
        taken_from(goal) if nearer == "where it stood" else place_of(goal),
        f"{nearer}, which is nearer",
        "When the cancel comes, compare the cup's distances in x and y to where it stood and to place_pose. Carry it "
        "to the nearer one, put it down, open the hand, withdraw it, then call canceled().",
    )
    return f"to {nearer}"


def gives_the_hand_to_one(goal: Goal) -> str | None:
    """Of two goals only one uses the hand: the second is rejected, or the first ends safely with PREEMPTED."""
    later = [other for other in life.rivals(goal) if other.sent.t > goal.sent.t]
    if not later or not accepted(goal) or not life.is_possible(goal):
        return None
    require_held_when(goal, later[0].sent.t)
    newer = successors(goal)
    if not newer:
        later[0].require_rejected(
            because="the hand is in use by another goal", help="Reject the second goal in goal_callback."
        )
        return "rejected"
    end = goal.require_result(
        ABORTED,
        help="Two goals used one hand. Reject the second goal in goal_callback, or end the first one with PREEMPTED.",
    )
    require_error_code(goal, "PREEMPTED", because="a later goal uses the hand now")
    goal.require_reason()
    _require_later(
        end,
        newer[0].sent.t,
        "the second goal was sent",
        "Abort with PREEMPTED only after another goal has been accepted.",
    )
    tilted = min(reports(goal.run, ev.ObjectTruth, newer[0].sent.t, goal.run.end), key=lambda cup: cup.up)
    expect(
        tilted.up >= MIN_UPRIGHT,
        expected="a cup that stays upright while the second goal preempts the first",
        observed="it fell over",
        help="In the first goal put down the cup, open the hand and withdraw it; only then start the second goal.",
        at=tilted.t,
    )
    return "preempted"


def _robbed_of_its_grasp(goal: Goal) -> float | None:
    """Return when (s) the scenario took the cup away, if the hand had not lifted it yet."""
    taken = life.robbed_at(goal) if life.ends_by_itself(goal) and not was_not_awaited(goal) else None
    return None if taken is None or carried(goal, taken) else taken


def _require_later(result: ev.ResultReceived, than: float, event: str, help: str) -> None:
    expect(
        result.t >= than,
        expected=f"the goal to go on until {event}",
        observed=f"it ended {than - result.t:.1f} s before that",
        help=help,
        at=result.t,
    )
