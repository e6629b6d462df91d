"""What becomes of the cup when a goal is cancelled, gives way to another, or cannot be carried out."""

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

FELL_OVER = 0.8
MOVED = 0.05  # rad
OPENED_BY = 0.01  # m
BEGINNING, LATE = 0.8, 4.0  # s without a pose after which an object may be, and must be, unknown
GRASP_TIMEOUT = 20.0  # s for a hand that does not arrive
CLOSE = 0.2  # m
BEFORE = 0.1  # s
ALIKE = 0.03  # m by which two places may be taken for equally near


# -- what cannot be carried out ---------------------------------------------------------------------------------------


def knows_what_is_unknown(goal: Goal) -> str | None:
    """An object whose pose nobody publishes ends the goal with UNKNOWN_OBJECT after 1 s."""
    name = goal.request.object_id
    if not accepted(goal) or goal.request.object_id == life.CUP:
        return None
    is_a_name = re.fullmatch(r"[A-Za-z_]\w*", name, re.ASCII) is not None
    result = require_aborted(
        goal,
        "UNKNOWN_OBJECT",
        because=f"nothing comes on objects/{name}/pose" if is_a_name else f"there is no object {name!r}",
        help="Wait at most 1 s for the first message on objects/<object_id>/pose, then abort."
        if is_a_name
        else "create_subscription() raises InvalidTopicNameException for a name with a space, or an empty one: catch "
        "it, and abort with UNKNOWN_OBJECT.",
    )
    took = result.t - goal.accepted_at
    expect(
        (BEGINNING if is_a_name else 0.0) <= took <= LATE,
        expected="the goal ABORTED after 1 s without a message",
        observed=f"it was after {took:.1f} s",
        help="Give the topic 1 s: its publisher sends 10 messages a second, but has to be found first.",
        at=result.t,
    )
    return "unknown" if is_a_name else "no name"


def refuses_what_is_out_of_reach(goal: Goal) -> str | None:
    """A cup or a place out of reach ends it with UNREACHABLE, before arm or hand move."""
    if not life.ends_by_itself(goal) or was_not_awaited(goal):
        return None
    if not life.is_for_the_cup(goal) or not life.is_far(goal):
        return None
    require_aborted(
        goal,
        "UNREACHABLE",
        because="the cup or its place is beyond the arm's reach",
        help="Ask compute_arm_ik for the grasp and for the place before you move; abort unless error_code is SUCCESS "
        "for both.",
    )
    _require_nothing_moved(goal)
    return "out of reach"


def _require_nothing_moved(goal: Goal) -> None:
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
    worst = max(seen, key=lambda grip: abs(grip.opening - seen[0].opening))
    moved = abs(worst.opening - seen[0].opening)
    expect(
        moved <= OPENED_BY,
        expected="a hand that stays as it is until the goal is known to be possible",
        observed=f"it opened or closed by {moved:.3f} m",
        help="Open the hand after compute_arm_ik has found both places, not before.",
        at=worst.t,
    )


# -- what goes wrong on the way ---------------------------------------------------------------------------------------


def notices_what_it_does_not_hold(goal: Goal) -> str | None:
    """When the fingers close on nothing the goal ends with GRASP_FAILED."""
    taken = _robbed_of_its_grasp(goal)
    if taken is None:
        return None
    result = require_aborted(
        goal,
        "GRASP_FAILED",
        because="nothing was between the fingers",
        help="The fingers closed on nothing, and the goal went on. After closing, r_gripper/wrench has to say at least "
        "1 N.",
    )
    _require_later(
        result, taken, "the cup was taken away", "Close the hand, wait, and look at the force then."
    )
    return "taken away"


def withdraws_what_is_empty(goal: Goal) -> str | None:
    """After a failed grasp the hand is open and withdrawn."""
    if _robbed_of_its_grasp(goal) is None or goal.result is None:
        return None
    require_withdrawn(goal, goal.result.t, taken_from(goal), opened=OPENED)
    return "taken away"


def notices_what_it_loses(goal: Goal) -> str | None:
    """When the cup is lost while it is lifted or moved the goal ends with DROPPED."""
    taken = life.robbed_at(goal) if life.ends_by_itself(goal) and not was_not_awaited(goal) else None
    if taken is None or not carried(goal, taken):
        return None
    require_held_when(goal, taken)
    result = require_aborted(
        goal,
        "DROPPED",
        because="the force vanished on the way",
        help="The cup was gone and the goal went on. While you hold it, look at r_gripper/wrench in every round.",
    )
    _require_later(
        result, taken, "the cup was lost", "Compare the measured force with 1 N, not with grasp_force."
    )
    return f"nearer to {life.nearer_place(goal, taken - BEFORE, 0.0)}"


def gives_up_in_time(goal: Goal) -> str | None:
    """A hand that does not get to the cup ends the goal with GRASP_FAILED within 20 s."""
    held = life.commanded(goal, "hold_joint") if life.ends_by_itself(goal) else None
    if held is None:
        return None
    result = require_aborted(
        goal,
        "GRASP_FAILED",
        because="the elbow was held, and the hand could not get to the cup",
        help="Something waits without a limit for the hand to arrive. Give each stage a time in which it must be over.",
    )
    expect(
        result.t - held <= GRASP_TIMEOUT + TIMEOUT_SLACK,
        expected=f"the goal ABORTED within {GRASP_TIMEOUT:.0f} s",
        observed=f"it was after {result.t - held:.0f} s",
        help="Give each stage a few seconds more than its trajectory takes.",
        at=result.t,
    )
    return "blocked"


def tells_a_fall(goal: Goal) -> str | None:
    """When the robot falls the goal is ABORTED with FELL."""
    if not life.ends_by_itself(goal) or life.commanded(goal, "push") is None:
        return None
    require_fall_reported(goal, require_knocked_over(goal.run))
    return "pushed"


# -- what ends it before it is done -----------------------------------------------------------------------------------


def leaves_the_cup(goal: Goal) -> str | None:
    """A cancel before the grasp ends CANCELED, with the hand withdrawn and the object where it was."""
    asked = life.canceled_at(goal)
    if asked is None or not life.is_possible(goal) or carried(goal, asked):
        return None
    goal.require_canceled(goal.requests_to_cancel[0])
    grip = grip_at(goal.run, asked)
    expect(
        grip.distance <= CLOSE,
        expected="the hand near the cup by then",
        observed=f"it is {grip.distance:.2f} m away",
        help="Bring the hand to the cup: approach it as soon as the goal executes.",
        at=asked,
    )
    assert goal.result
    require_standing(
        goal,
        taken_from(goal),
        "where it stood",
        "Nothing is held yet: open the hand and draw it straight back, away from the cup, then call canceled().",
    )
    return "closing" if grip.force > 0.0 else "approaching"


def puts_away(goal: Goal) -> str | None:
    """A cancel while it holds the object puts it down where it was taken or shall stand, whichever is nearer."""
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
        "When the cancel comes, compare how far the cup is from where it stood and from place_pose, in x and y; "
        "carry it to the nearer one, put it down, open, withdraw, then call canceled().",
    )
    return f"to {nearer}"


def gives_the_hand_to_one(goal: Goal) -> str | None:
    """Of two goals one has the hand: the second is rejected, or the first ends safely with PREEMPTED."""
    later = [other for other in life.rivals(goal) if other.sent.t > goal.sent.t]
    if not later or not accepted(goal) or not life.is_possible(goal):
        return None
    require_held_when(goal, later[0].sent.t)
    newer = successors(goal)
    if not newer:
        later[0].require_rejected(because="the hand is busy", help="Reject it in goal_callback.")
        return "rejected"
    end = goal.require_result(
        ABORTED,
        help="Two goals had one hand. Reject the second one in goal_callback, or end the first one with PREEMPTED.",
    )
    require_error_code(goal, "PREEMPTED", because="a later goal has the hand")
    goal.require_reason()
    _require_later(
        end,
        newer[0].sent.t,
        "the second one came",
        "Abort with PREEMPTED only when another goal has been accepted.",
    )
    tilted = min(reports(goal.run, ev.ObjectTruth, newer[0].sent.t, goal.run.end), key=lambda cup: cup.up)
    expect(
        tilted.up >= FELL_OVER,
        expected="a cup that stays upright while one goal gives way to another",
        observed="it fell over",
        help="Put down what is held, open, withdraw, and only then let the other goal begin.",
        at=tilted.t,
    )
    return "gave way"


def _robbed_of_its_grasp(goal: Goal) -> float | None:
    """Return when (s) the cup was taken from a goal that had not lifted it yet."""
    taken = life.robbed_at(goal) if life.ends_by_itself(goal) and not was_not_awaited(goal) else None
    return None if taken is None or carried(goal, taken) else taken


def _require_later(result: ev.ResultReceived, than: float, event: str, help: str) -> None:
    expect(
        result.t >= than,
        expected=f"the goal to go on until {event}",
        observed=f"it ended {than - result.t:.1f} s before",
        help=help,
        at=result.t,
    )
