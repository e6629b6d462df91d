"""How a goal ends: the robot arrives, another goal preempts it, or the robot falls."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise

from autograder.authoring.diagnosis.goal_diagnosis import error_name, why_rclpy_aborted
from autograder.authoring.diagnosis.missing import not_shown
from autograder.authoring.evidence.goal import ABORTED, SUCCEEDED, Goal
from autograder.authoring.failure import expect
from autograder.authoring.requirements.falls import DETECTION_LEAD, fall_after
from autograder.authoring.walking import life, reports
from autograder.authoring.walking.motion import require_reached
from autograder.authoring.walking.planar import error
from autograder.authoring.walking.truth import require_arrival
from humanoid_interfaces.msg import RobotState
from ros_runtime.message_constants import GoalStatus, name_of

PREEMPTION_TIME = 5.0  # s
_WENT_ON = (
    "The old goal went on after the new one was accepted. Store the newest goal in handle_accepted_callback, and let "
    "the loop of each goal check whether it is still the newest."
)


def comes_near(goal: Goal) -> str | None:
    """It walks: the robot comes within 0.10 m and 0.15 rad of the goal."""
    return _arrives(goal, require_reached)


def succeeds(goal: Goal) -> str | None:
    """It SUCCEEDS, and the robot is then within 0.10 m and 0.15 rad of the goal."""
    return _arrives(goal, require_arrival)


def goes_on(goal: Goal) -> str | None:
    """A goal goes on when another goal is rejected, or its cancel is refused."""
    if not life.accepted(goal) or goal.answer is None:
        return None
    rejected = any(
        other.answer and not other.answer.accepted and goal.answer.t < other.sent.t < life.ended_at(goal)
        for other in life.others(goal)
    )
    refused = any(cancel.answer and not cancel.answer.canceling for cancel in life.cancels_on_the_way(goal))
    if not rejected and not refused:
        return None
    what, result = "another was rejected" if rejected else "the cancel was refused", goal.result
    if result is None or life.was_disturbed(goal):
        return what
    expect(
        result.status == SUCCEEDED and life.near_arrival(goal, result.t),
        expected=f"the first goal to go on after {what}",
        observed=f"it ended {name_of(GoalStatus, result.status)} at {result.t:.1f} s",
        help=why_rclpy_aborted(goal) or f"Let the active goal go on when {what}.",
        at=result.t,
    )
    return what


def gives_way(goal: Goal) -> str | None:
    """A goal that was accepted later aborts the one that is active, with PREEMPTED."""
    newer = life.successors(goal)
    if not newer:
        _require_no_preemption(goal)
        return None
    came = newer[0].sent.t
    canceled = any(cancel.sent.t <= came for cancel in life.granted(goal))
    if (
        canceled
        or life.fell_or_lost_power(goal)
        or (goal.status == SUCCEEDED and life.near_arrival(goal, came))
    ):
        return None
    require_preempted(goal, came, _WENT_ON)
    return f"by {len(newer)} newer"


def require_preempted(goal: Goal, newer_sent: float, help: str) -> None:
    """Require that a goal ended as PREEMPTED soon after a newer goal was sent, at `newer_sent` (s).

    `help` is the next step for a goal that continued.
    """
    end = goal.require_result(ABORTED, help=help)
    reports.require_error_code(goal, "PREEMPTED", because="a new goal has taken its place", help=help)
    expect(
        end.t <= newer_sent + PREEMPTION_TIME,
        expected=f"the old goal to end within {PREEMPTION_TIME:g} s of the new one",
        observed=f"it ended {end.t - newer_sent:.1f} s after it",
        help=help,
        at=end.t,
    )


def only_one_is_newest(goal: Goal) -> str | None:
    """Of goals that are accepted in the same moment all but one give way."""
    together = [goal, *life.together_with(goal)]
    if len(together) == 1 or goal.result is None or life.successors(goal):
        return None
    if any(life.fell_or_lost_power(each) or life.granted(each) for each in together):
        return None
    kept = [each for each in together if each.result is None or not _was_preempted(each)]
    expect(
        len(kept) == 1,
        expected="one of the goals that were accepted together to go on, and the others to end PREEMPTED",
        observed=f"{len(kept)} of {len(together)} went on",
        help="Two goals can be accepted before either executes: store the newest goal in handle_accepted_callback, and "
        "let only the loop of that goal publish on cmd_vel.",
        at=goal.result.t,
    )
    return f"{len(together)} together"


def tells_a_fall(goal: Goal) -> str | None:
    """When the robot falls, pushed or without power, the goal is ABORTED with FELL."""
    down = life.fell_or_lost_power(goal)
    if down is None or any(cancel.sent.t < down.t for cancel in life.granted(goal)):
        return None
    if any(other.sent.t < down.t for other in life.successors(goal)) or life.together_with(goal):
        return None
    fallen = fall_after(goal.run, down.t)
    if fallen is None:
        raise not_shown(goal.run, "a robot without power, or pushed over, falls")
    if goal.result is None and life.was_not_awaited(goal):
        return None
    if goal.result and goal.status == SUCCEEDED and goal.result.t <= fallen.t:
        return "as it arrived"
    result = goal.require_result(
        ABORTED,
        help=f"The robot fell at {fallen.t:.1f} s and execute went on. Check robot_state.mode in every round.",
    )
    expect(
        result.t >= down.t - DETECTION_LEAD,
        expected="the goal to go on until the robot falls",
        observed=f"it ended {down.t - result.t:.1f} s before the robot fell",
        help="A push alone is no reason to give up: abort when robot_state.mode is FALLEN.",
        at=result.t,
    )
    if result.t >= fallen.t or down.mode == RobotState.FALLEN:
        reports.require_error_code(goal, "FELL", because="the robot has fallen")
    return "pushed" if down.mode == RobotState.FALLEN else "without power"


def status_in_order(goal: Goal) -> str | None:
    """A goal's status goes forward: accepted, executing, perhaps canceling, and then one final status."""
    seen = [each.status for each in goal.statuses]
    if not seen or not life.accepted(goal):
        return None
    for earlier, later in pairwise(seen):
        expect(
            later > earlier and earlier not in life.TERMINAL,
            expected=f"no other status after {name_of(GoalStatus, earlier)}",
            observed=name_of(GoalStatus, later),
            help="Make one terminal call for a goal, and none after it.",
            at=goal.statuses[-1].t,
        )
    if goal.result:
        final = [status for status in seen if status in life.TERMINAL]
        expect(
            not final or final == [goal.result.status],
            expected=f"the status {name_of(GoalStatus, goal.result.status)} that came with the result",
            observed=", ".join(name_of(GoalStatus, status) for status in final),
            help="Make one terminal call for a goal, and none after it.",
            at=goal.result.t,
        )
    return name_of(GoalStatus, seen[-1])


def _arrives(goal: Goal, require: Callable[[Goal], object]) -> str | None:
    if not life.is_undisturbed(goal) or life.was_not_awaited(goal):
        return None
    require(goal)
    distance, turn = error(goal.run.robot_at(goal.sent.t), goal)
    way = "here" if distance < life.AT_GOAL_DISTANCE else "a walk"
    turned = "turning back" if turn > 2.0 else "turning" if turn > life.BIG_TURN else "ahead"
    return f"{way}, {turned}; {life.phase(goal)}"


def _require_no_preemption(goal: Goal) -> None:
    """Require that a goal did not give way to a goal that was rejected or never sent."""
    expect(
        not _was_preempted(goal) or bool(life.together_with(goal)),
        expected="a goal that goes on: no other was accepted while it was active",
        observed="it ended ABORTED with PREEMPTED",
        help="Let the old goal give way in handle_accepted_callback: goal_callback may still reject the new one.",
        at=goal.result.t if goal.result else None,
    )


def _was_preempted(goal: Goal) -> bool:
    return goal.status == ABORTED and error_name(goal) == "PREEMPTED"
