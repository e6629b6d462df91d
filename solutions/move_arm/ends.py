"""How a goal for an arm ends: the arm arrives or does not, or the goal is cancelled or preempted."""

from __future__ import annotations

from autograder.authoring import ABORTED, SUCCEEDED, Goal, error_name, expect
from autograder.authoring.walking.life import cancels_on_the_way, granted, phase, successors, was_not_awaited
from autograder.authoring.walking.obligations.ends import require_preempted
from autograder.authoring.walking.reports import require_error_code

from . import life
from .endings import ARRIVAL_TIME, require_not_given_up, tolerance_of
from .motion import require_moving
from .truth import joints_between, plan_of, worst_at

ANSWER_DELAY = 0.5  # s by which a server may have started a goal before the client received its acceptance
PATH_SLACK = 0.15  # rad below PATH_TOLERANCE, at which a server may already abort
REACTION_TIME = 1.5  # s for the server to end the goal
OVERTAKING_TIME = 0.3  # s; requests sent within this time may arrive in either order
MIN_SILENCE = 0.8  # s without joint_states, before which the goal may not be aborted
NOTICE_TIME = 1.5  # s without joint_states, after which a server has noticed that
MAX_SILENCE = 2.0  # s without joint_states, until which the goal must be aborted
_SILENT = "Store the time of the last joint_states message, and abort when that is more than 1 s ago."
_WENT_ON = (
    "The old goal went on after the new one was accepted. In handle_accepted_callback, store the arm's newest goal; "
    "in each round of execute, abort with PREEMPTED if that is another goal."
)
_OTHER_ARM = (
    "The robot follows one trajectory at a time: a new message on joint_trajectory replaces the old one, also for the "
    "other arm, and an empty one stops both. Publish one trajectory with the remaining points of both goals, with "
    "times counted from now."
)
_LATE = (
    "End the goal as soon as its last point is due and every joint in joint_states is within goal_tolerance."
)
_BY_NAME = (
    "joint_states listed the joints in another order than before. In each message, use dict(zip(message.name, "
    "message.position)), and look up each joint by its name."
)


def succeeds(goal: Goal) -> str | None:
    """The goal SUCCEEDS when its last point is due and every joint is within goal_tolerance of it."""
    if not _ends_by(goal, life.Fate.ARRIVES):
        return None
    require_not_given_up(goal, _why_given_up(goal))
    result, plan, tolerance = goal.require_result(SUCCEEDED), plan_of(goal), tolerance_of(goal)
    expect(
        result.t >= plan.end - ANSWER_DELAY,
        expected="the goal to go on until its last point is due",
        observed=f"it SUCCEEDED {plan.end - result.t:.1f} s before that",
        help="An arm may pass its final position earlier, and a small error on the way is no arrival. Wait until the "
        "last point's time_from_start is over.",
        at=result.t,
        see="09_arms#tolerances-gap",
    )
    joint, error = worst_at(goal, result.t, plan.final())
    expect(
        error <= tolerance + life.MEASUREMENT_SLACK,
        expected=f"every joint within {tolerance:.2f} rad of the last point when the goal SUCCEEDED",
        observed=f"{joint} was {error:.2f} rad away in the simulator",
        help="Wait until the last point's time_from_start is over. Before succeed(), compare each joint's position in "
        "joint_states with its position in the last point.",
        at=result.t,
    )
    expect(
        result.t <= plan.end + ARRIVAL_TIME + REACTION_TIME,
        expected=f"the goal to end at most {ARRIVAL_TIME:g} s after its last point is due",
        observed=f"it SUCCEEDED {result.t - plan.end:.1f} s after the last point was due",
        help=_OTHER_ARM if life.situation(goal).endswith("arm") else _LATE,
        at=result.t,
    )
    return f"{life.situation(goal)}; {phase(goal)}"


def misses(goal: Goal) -> str | None:
    """If a joint has not arrived 1 s after the last point is due, the goal ends with GOAL_TOLERANCE_VIOLATED."""
    hold = life.hold_of(goal) if _ends_by(goal, life.Fate.MISSES) else None
    if hold is None:
        return None
    plan = plan_of(goal)
    result = goal.require_result(
        ABORTED,
        help="Call succeed() only when every joint in joint_states is within goal_tolerance of the last point."
        if goal.result
        else "The goal never ended. 1 s after the last point's time_from_start, abort with GOAL_TOLERANCE_VIOLATED.",
    )
    require_error_code(
        goal, "GOAL_TOLERANCE_VIOLATED", because=f"{hold.joints[-1]} was blocked short of the last point"
    )
    expect(
        plan.end - ANSWER_DELAY <= result.t <= plan.end + ARRIVAL_TIME + REACTION_TIME,
        expected=f"the goal to end 1 s after its last point was due at {plan.end:.1f} s",
        observed=f"it ended {abs(result.t - plan.end):.1f} s {'after' if result.t > plan.end else 'before'} that time",
        help="Wait until the last point's time_from_start is over. Then wait at most 1 s for every joint to be within "
        "goal_tolerance.",
        at=result.t,
    )
    return f"{len(hold.joints)} blocked"


def strays(goal: Goal) -> str | None:
    """If the arm is more than 0.5 rad off its trajectory, the goal ends with PATH_TOLERANCE_VIOLATED."""
    hold = life.hold_of(goal) if _ends_by(goal, life.Fate.STRAYS) else None
    if hold is None:
        return None
    joint, plan = hold.joints[-1], plan_of(goal)
    require_moving(goal, hold.since)
    result = goal.require_result(
        ABORTED,
        help=f"{joint} was blocked. In every round, compare each joint's position in joint_states with its position on "
        "the trajectory at that time.",
    )
    off = max(
        abs(report.positions[joint] - plan.at(report.t)[joint])
        for report in joints_between(goal.run, min(hold.since, result.t), result.t)
    )
    expect(
        off >= life.PATH_TOLERANCE - PATH_SLACK,
        expected=f"the goal to go on until {joint} is {life.PATH_TOLERANCE} rad off its trajectory",
        observed=f"it ended when {joint} was {off:.2f} rad off",
        help="An arm always lags a little behind. Abort only at more than 0.5 rad from the joint's position on the "
        "trajectory at that time.",
        at=result.t,
    )
    late = result.t - life.first_off(goal, hold)
    expect(
        late <= REACTION_TIME,
        expected=f"the goal ABORTED as soon as {joint} is {life.PATH_TOLERANCE} rad off",
        observed=f"ABORTED {late:.1f} s later",
        help="Check the deviation in every round, not only at the end.",
        at=result.t,
    )
    because = f"{joint} was blocked, and more than {life.PATH_TOLERANCE} rad off its trajectory"
    require_error_code(goal, "PATH_TOLERANCE_VIOLATED", because=because)
    return "blocked"


def notices_silence(goal: Goal) -> str | None:
    """When no joint_states come for 1 s, the goal ends with INVALID_JOINTS."""
    lost = life.silent_since(goal) if life.is_carried_out(goal) else None
    if lost is None or lost < goal.accepted_at or granted(goal) or successors(goal) or was_not_awaited(goal):
        return None
    require_moving(goal, lost)
    result = goal.require_result(ABORTED, help=_SILENT)
    _, seems_off = worst_at(goal, lost, plan_of(goal).at(lost + NOTICE_TIME))
    if seems_off < life.PATH_TOLERANCE - PATH_SLACK or error_name(goal) != "PATH_TOLERANCE_VIOLATED":
        because = "joint_states stopped"
        require_error_code(goal, "INVALID_JOINTS", because=because, help=_SILENT)
    expect(
        MIN_SILENCE <= result.t - lost <= MAX_SILENCE,
        expected="the goal ABORTED 1 s after the last joint_states",
        observed=f"ABORTED {result.t - lost:.1f} s after it",
        help="In every round, compare the time of the last joint_states message with the current time.",
        at=result.t,
    )
    return "on the way"


def grants_cancels(goal: Goal) -> str | None:
    """A cancel at any moment is accepted, and the goal ends CANCELED."""
    asked = cancels_on_the_way(goal) if life.is_carried_out(goal) else []
    if not asked or any(other.sent.t < asked[0].sent.t + OVERTAKING_TIME for other in successors(goal)):
        return None
    first, due = asked[0], plan_of(goal).end
    if goal.status == SUCCEEDED and first.sent.t > due - ANSWER_DELAY:
        return "just before arrival"
    is_early = first.sent.t < goal.accepted_at + ANSWER_DELAY
    if first.answer and is_early:
        expect(
            goal.name in first.answer.canceling,
            expected="the server to accept the cancel at any moment",
            observed=f"it rejected the cancel {first.answer.t - goal.accepted_at:.1f} s after it accepted the goal",
            help="Return CancelResponse.ACCEPT at any moment, also before the arm moves.",
            at=first.answer.t,
        )
    goal.require_canceled(first)
    return "at once" if is_early else "on the way"


def gives_way(goal: Goal) -> str | None:
    """A new goal for the same arm aborts the old one with PREEMPTED."""
    newer = successors(goal)
    if not life.is_carried_out(goal):
        return None
    if not newer:
        if error_name(goal) == "PREEMPTED" and life.ends_by_itself(goal):
            require_not_given_up(goal)
        return None
    came = newer[0].sent.t
    canceled = any(cancel.sent.t <= came + OVERTAKING_TIME for cancel in granted(goal))
    if canceled or (goal.status == SUCCEEDED and came > plan_of(goal).end - ANSWER_DELAY):
        return None
    if came >= goal.accepted_at + ANSWER_DELAY:
        require_moving(goal, came)
    require_preempted(goal, came, _WENT_ON)
    return f"by {len(newer)} newer"


def _ends_by(goal: Goal, fate: life.Fate) -> bool:
    """Return whether this fate, and nothing else, ends the goal, and the scenario waited for the result."""
    return life.ends_by_itself(goal) and not was_not_awaited(goal) and life.fate_of(goal) is fate


def _why_given_up(goal: Goal) -> str:
    """Return advice on an aborted goal if a known cause is likely: another order of names, or the other arm's goal."""
    if any(each.t < goal.sent.t for each in goal.run.commands("joint_states")):
        return _BY_NAME
    return _OTHER_ARM if life.situation(goal).endswith("arm") else ""
