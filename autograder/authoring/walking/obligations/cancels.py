"""How a request to cancel a goal is answered, and how the goal ends after it."""

from __future__ import annotations

from autograder.authoring.diagnosis.goal_diagnosis import why_rclpy_aborted
from autograder.authoring.evidence.goal import ABORTED, CANCELED, SUCCEEDED, Goal
from autograder.authoring.failure import Failure, expect
from autograder.authoring.walking import life
from autograder.authoring.walking.truth import STOP_TIME, require_stopped, require_walking
from humanoid_interfaces.msg import RobotState

START_TIME = 1.0  # s from the acceptance until the robot walks
OVERTAKING_TIME = 0.3  # s; a goal that is sent so soon after a cancel may arrive before it


def refuses_cancels(goal: Goal) -> str | None:
    """It refuses every request to cancel, at any moment."""
    if not goal.cancels:
        return None
    for cancel in goal.cancels:
        result = goal.result
        ended = result and result.t <= cancel.sent.t and result.status == ABORTED
        if result and ended and not life.fell_or_lost_power(goal) and not life.successors(goal):
            raise Failure(
                expected="a goal that is still active when the request to cancel comes",
                observed=f"it had ended at {result.t:.1f} s",
                help=why_rclpy_aborted(goal)
                or "A walk of 2 m takes longer: end the goal when the robot has arrived.",
                at=result.t,
            )
        if cancel.answer is None:
            cancel.require_agreed(goal)  # raises: there was no answer
            return None
        expect(
            not cancel.answer.canceling,
            expected="the request to cancel refused (no goal in goals_canceling)",
            observed="it was accepted",
            help="Give ActionServer no cancel_callback: rclpy refuses every cancel then. Do not accept what execute "
            "does not do; chapter 7 adds it.",
            at=cancel.answer.t,
        )
    return f"{len(goal.cancels)} asked, {_when(goal, goal.cancels[0].sent.t)}"


def grants_cancels(goal: Goal) -> str | None:
    """A cancel while the goal is active is accepted, and the goal ends CANCELED."""
    asked = life.requests_to_cancel(goal)
    if not asked:
        return None
    accepted_at, result = goal.accepted_at, goal.result
    early = [cancel for cancel in life.granted(goal) if cancel.sent.t < accepted_at]
    first = next((cancel for cancel in asked if cancel.sent.t >= accepted_at), None)
    if early or first is None:
        return _ends_canceled(goal, early[0].sent.t) if early else None
    down = life.fell_or_lost_power(goal)
    if any(other.sent.t < first.sent.t for other in life.successors(goal)) or (
        down and down.t < first.sent.t
    ):
        return None
    if result and result.t <= first.sent.t and goal.status == SUCCEEDED and life.near_arrival(goal, result.t):
        return None  # the cancel came after the end
    if goal.status == SUCCEEDED and life.near_arrival(goal, first.sent.t):
        return "just before arrival"
    first.require_agreed(goal)
    return _ends_canceled(goal, first.sent.t)


def walks_until_canceled(goal: Goal) -> str | None:
    """The robot walks when the cancel comes."""
    asked = life.requests_to_cancel(goal)
    if not asked:
        return None
    first = asked[0].sent.t
    if first < goal.accepted_at + START_TIME or life.near_arrival(goal, first):
        return None
    require_walking(life.run_of(goal), first)
    return "in mid-stride"


def refuses_late_cancels(goal: Goal) -> str | None:
    """A cancel after the end is refused and changes nothing."""
    late = [cancel for cancel in goal.cancels if goal.result and goal.result.t < cancel.sent.t]
    for cancel in late:
        expect(
            cancel.answer is not None and not cancel.answer.canceling,
            expected="the cancel of a goal that has ended to be refused",
            observed="no answer" if cancel.answer is None else "the server accepted the cancel",
            help="Keep no list of goals of your own: rclpy knows which goals are active and refuses the others.",
            at=cancel.sent.t,
        )
    return "after the end" if late else None


def answers_every_cancel(goal: Goal) -> str | None:
    """Every request to cancel is answered, also the second for the same goal."""
    for cancel in goal.cancels:
        if cancel.answer is None:
            cancel.require_agreed(goal)  # raises: there was no answer
    return f"{len(goal.cancels)} asked" if goal.cancels else None


def stops_when_canceled(goal: Goal) -> str | None:
    """Within 2 s of the cancel the robot stands still and upright, and stays so."""
    active = [cancel for cancel in life.requests_to_cancel(goal) if cancel.sent.t < life.ended_at(goal)]
    obeyed = [each for each in active if goal.status == SUCCEEDED or each in life.granted(goal)]
    if not obeyed or life.successors(goal):
        return None
    asked = obeyed[0].sent.t
    end = min(life.next_sent(goal, asked), life.run_of(goal).end)
    if end < asked + STOP_TIME + life.MIN_STANDING_TIME:
        return None
    require_stopped(goal.run, asked, until=end)
    return _when(goal, asked)


def _when(goal: Goal, t: float) -> str:
    """Return, for the table of clauses, at which moment of a goal's life something came at `t` s."""
    if goal.answer is None or t < goal.answer.t:
        return "before acceptance"
    if t > life.ended_at(goal):
        return "after the end"
    is_walking = any(robot.mode == RobotState.WALKING for robot in goal.run.robot_between(t - 0.3, t))
    return "in mid-stride" if is_walking else "before the first step"


def _ends_canceled(goal: Goal, asked: float) -> str | None:
    """Require that a goal whose cancel was accepted ends CANCELED, or SUCCEEDED if that was just before arrival.

    That also holds if another goal comes after the cancel, unless it may have overtaken the cancel.
    """
    commands = (*goal.run.commands("push"), *goal.run.commands("motor_power"))
    was_put_down = any(goal.sent.t <= each.t <= life.ended_at(goal) for each in commands)
    if life.was_not_awaited(goal) or (life.fell_or_lost_power(goal) and was_put_down):
        return None
    if any(other.sent.t < asked + OVERTAKING_TIME for other in life.successors(goal)):
        return None
    if goal.status == SUCCEEDED and life.near_arrival(goal, asked):
        return "just before arrival"
    goal.require_result(CANCELED)
    return "and another came" if life.successors(goal) else _when(goal, asked)
