"""How a goal for an arm ends: the arm arrives or does not, the goal is cancelled, or another takes the arm."""

from __future__ import annotations

from autograder.authoring import ABORTED, SUCCEEDED, Goal, error_name, expect
from autograder.authoring.walking.life import cancels_on_the_way, granted, phase, successors, was_not_awaited
from autograder.authoring.walking.obligations.ends import require_preempted
from autograder.authoring.walking.reports import require_error_code

from . import life
from .endings import ARRIVAL_TIME, require_not_given_up, tolerance_of
from .motion import require_moving
from .truth import joints_between, plan_of, worst_at

ANSWER_DELAY = 0.5  # s that a server may have begun before its answer was seen
SOONER = 0.15  # rad less, at which a server may already see that a joint is off
REACTION = 1.5  # s for the server to say so
OVERTAKING = 0.3  # s
QUIET = 0.8  # s without joint_states before which nobody may give up
NOTICE_TIME = 1.5  # s without them after which a server has noticed
GIVEN_UP = 2.0  # s
_SILENT = "Remember when the last joint_states came, and give up when that is more than 1 s ago."
_WENT_ON = (
    "The old goal went on after the new one was accepted. How does its loop learn that it is no longer the arm's "
    "newest? (handle_accepted_callback)"
)
_OTHER_ARM = (
    "The robot follows one trajectory at a time: a new message on joint_trajectory replaces the old one, also for the "
    "other arm, and an empty one holds both. Publish one trajectory with what is left of both, its times counted from "
    "now."
)
_LATE = "Let it end as soon as the last point's time is over and joint_states say that every joint is there."
_BY_NAME = (
    "joint_states listed the joints in another order than before. Pair message.name with message.position anew in "
    "each message, and look each joint up by its name."
)


def succeeds(goal: Goal) -> str | None:
    """It SUCCEEDS when the last point's time is over and every joint is within goal_tolerance of it."""
    if not _ends_by(goal, life.Fate.ARRIVES):
        return None
    require_not_given_up(goal, _why_given_up(goal))
    result, plan, tolerance = goal.require_result(SUCCEEDED), plan_of(goal), tolerance_of(goal)
    expect(
        result.t >= plan.end - ANSWER_DELAY,
        expected="the goal to go on until its last point is due",
        observed=f"it SUCCEEDED {plan.end - result.t:.1f} s before",
        help="The arm may come by its last point on the way. Wait until the last point's time_from_start is over.",
        at=result.t,
    )
    joint, error = worst_at(goal, result.t, plan.final())
    expect(
        error <= tolerance + life.MEASURED,
        expected=f"every joint within {tolerance:.2f} rad of the last point when the goal SUCCEEDED",
        observed=f"{joint} is {error:.2f} rad away in the simulator",
        help="Wait until the last point's time_from_start is over, then compare joint_states with its positions, "
        "joint by joint, before succeed().",
        at=result.t,
    )
    expect(
        result.t <= plan.end + ARRIVAL_TIME + REACTION,
        expected=f"the goal to end within {ARRIVAL_TIME:g} s of its last point's time",
        observed=f"it SUCCEEDED {result.t - plan.end:.1f} s after it",
        help=_OTHER_ARM if life.situation(goal).endswith("arm") else _LATE,
        at=result.t,
    )
    return f"{life.situation(goal)}; {phase(goal)}"


def misses(goal: Goal) -> str | None:
    """A joint that is not at its end 1 s after it is due ends the goal with GOAL_TOLERANCE_VIOLATED."""
    hold = life.hold_of(goal) if _ends_by(goal, life.Fate.MISSES) else None
    if hold is None:
        return None
    plan = plan_of(goal)
    result = goal.require_result(
        ABORTED,
        help="Succeed only when joint_states say that every joint is within goal_tolerance of the last point."
        if goal.result
        else "The goal never ended. 1 s after the last point's time_from_start, abort with GOAL_TOLERANCE_VIOLATED.",
    )
    require_error_code(
        goal, "GOAL_TOLERANCE_VIOLATED", because=f"{hold.joints[-1]} was held short of the last point"
    )
    expect(
        plan.end - ANSWER_DELAY <= result.t <= plan.end + ARRIVAL_TIME + REACTION,
        expected="the goal to end 1 s after its last point was due",
        observed=f"it ended {result.t - plan.end:+.1f} s after that",
        help="Wait for the last point's time_from_start, then at most 1 s for every joint to be within goal_tolerance.",
        at=result.t,
    )
    return f"{len(hold.joints)} held"


def strays(goal: Goal) -> str | None:
    """An arm that is more than 0.5 rad off its trajectory ends the goal with PATH_TOLERANCE_VIOLATED."""
    hold = life.hold_of(goal) if _ends_by(goal, life.Fate.STRAYS) else None
    if hold is None:
        return None
    joint, plan = hold.joints[-1], plan_of(goal)
    require_moving(goal, hold.since)
    result = goal.require_result(
        ABORTED,
        help=f"{joint} was held. Compare joint_states with where the trajectory has each joint at that moment, in "
        "every round.",
    )
    off = max(
        abs(report.positions[joint] - plan.at(report.t)[joint])
        for report in joints_between(goal.run, min(hold.since, result.t), result.t)
    )
    expect(
        off >= life.PATH_TOLERANCE - SOONER,
        expected=f"the goal to go on until {joint} is {life.PATH_TOLERANCE} rad off its trajectory",
        observed=f"it ended when {joint} was {off:.2f} rad off",
        help="An arm is always a little late. Abort only over 0.5 rad, and measure from where the trajectory has the "
        "joint now.",
        at=result.t,
    )
    late = result.t - life.first_off(goal, hold)
    expect(
        late <= REACTION,
        expected=f"the goal ABORTED as soon as {joint} is {life.PATH_TOLERANCE} rad off",
        observed=f"{late:.1f} s later",
        help="Look at the deviation in every round, not only at the end.",
        at=result.t,
    )
    because = f"{joint} was held, and more than {life.PATH_TOLERANCE} rad off its trajectory"
    require_error_code(goal, "PATH_TOLERANCE_VIOLATED", because=because)
    return "held"


def notices_silence(goal: Goal) -> str | None:
    """When joint_states say nothing for 1 s the goal ends with INVALID_JOINTS."""
    lost = life.silent_since(goal) if life.is_carried_out(goal) else None
    if lost is None or lost < goal.accepted_at or granted(goal) or successors(goal) or was_not_awaited(goal):
        return None
    require_moving(goal, lost)
    result = goal.require_result(ABORTED, help=_SILENT)
    _, seems_off = worst_at(goal, lost, plan_of(goal).at(lost + NOTICE_TIME))
    if seems_off < life.PATH_TOLERANCE - SOONER or error_name(goal) != "PATH_TOLERANCE_VIOLATED":
        because = "nothing is known of the joints any more"
        require_error_code(goal, "INVALID_JOINTS", because=because, help=_SILENT)
    expect(
        QUIET <= result.t - lost <= GIVEN_UP,
        expected="the goal ABORTED 1 s after the last joint_states",
        observed=f"{result.t - lost:.1f} s after it",
        help="Compare the time of the last joint_states with now, in every round.",
        at=result.t,
    )
    return "on the way"


def grants_cancels(goal: Goal) -> str | None:
    """A cancel at any moment is agreed to and ends CANCELED."""
    asked = cancels_on_the_way(goal) if life.is_carried_out(goal) else []
    if not asked or any(other.sent.t < asked[0].sent.t + OVERTAKING for other in successors(goal)):
        return None
    first, due = asked[0], plan_of(goal).end
    if goal.status == SUCCEEDED and first.sent.t > due - ANSWER_DELAY:
        return "just before arrival"
    is_early = first.sent.t < goal.accepted_at + ANSWER_DELAY
    if first.answer and is_early:
        expect(
            goal.name in first.answer.canceling,
            expected="the server to agree to cancel, as it does later on",
            observed=f"it refused {first.answer.t - goal.accepted_at:.1f} s after the acceptance",
            help="Return CancelResponse.ACCEPT at any moment: before the arm moves there is a trajectory to take back, "
            "too.",
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
    canceled = any(cancel.sent.t <= came + OVERTAKING for cancel in granted(goal))
    if canceled or (goal.status == SUCCEEDED and came > plan_of(goal).end - ANSWER_DELAY):
        return None
    if came >= goal.accepted_at + ANSWER_DELAY:
        require_moving(goal, came)
    require_preempted(goal, came, _WENT_ON)
    return f"by {len(newer)} newer"


def _ends_by(goal: Goal, fate: life.Fate) -> bool:
    """Return whether this fate, and nothing else, ends the goal, and the scenario waited for its end."""
    return life.ends_by_itself(goal) and not was_not_awaited(goal) and life.fate_of(goal) is fate


def _why_given_up(goal: Goal) -> str:
    """Return what to do about a goal that was given up, where something happened that may have led there."""
    if any(each.t < goal.sent.t for each in goal.run.commands("joint_states")):
        return _BY_NAME
    return _OTHER_ARM if life.situation(goal).endswith("arm") else ""
