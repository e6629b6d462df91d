"""Why a goal ended otherwise than it should, or not at all, and what to do: by its status, its feedback and the log."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING

from autograder.authoring.diagnosis.exit_diagnosis import raised_in
from autograder.authoring.diagnosis.stack_location import where_it_waited
from autograder.authoring.evidence import events as ev
from ros_runtime.message_constants import GoalStatus, name_of

if TYPE_CHECKING:
    from autograder.authoring.evidence.goal import Goal

STILL_COMING = 1.5  # s; a goal whose last feedback is not older is still in its loop
FROZEN = 10  # feedback messages; so many alike are no coincidence while the robot moves
MOVED = 0.05  # m
AWAY = 0.5  # m farther from the goal than at first
BLIND = "05_executors#one-why"
IN_THE_LOG = 0.5  # s that a line of the log may come after the result it explains
_CALLS: dict[int, str] = {
    GoalStatus.SUCCEEDED: "succeed",
    GoalStatus.CANCELED: "canceled",
    GoalStatus.ABORTED: "abort",
}
_CANCELED_INSTEAD: dict[int, str] = {
    GoalStatus.SUCCEEDED: "An accepted cancel ends with goal_handle.canceled(), not succeed(): look at "
    "is_cancel_requested in every round.",
    GoalStatus.ABORTED: "Once is_cancel_requested is seen, stop the robot, call goal_handle.canceled() and return.",
}
_FORBIDDEN = re.compile(r"invalid transition from state (\w+) with event (\w+)")
ABORTED_BY_RCLPY = "06_walk_to_a_pose#move-why"
_ABORT = "Call goal_handle.abort(), with the reason in result.error_code, when the goal cannot be reached any more."


def why_it_ended_so(goal: Goal, wanted: int) -> str:
    """Return what to do about a goal that ended with another status than `wanted`."""
    ended = goal.status or GoalStatus.UNKNOWN
    if ended == GoalStatus.ABORTED and (unmeant := why_rclpy_aborted(goal)):
        return unmeant
    code = error_name(goal)
    if wanted == GoalStatus.CANCELED and ended == GoalStatus.ABORTED and code not in ("", "NONE"):
        return (
            f"After the cancel your server aborted the goal with {code}: what it does first on a cancel led there. "
            "Leave robot and object safe, and then call goal_handle.canceled()."
        )
    if wanted == GoalStatus.CANCELED and ended in _CANCELED_INSTEAD:
        return _CANCELED_INSTEAD[ended]
    if wanted == GoalStatus.ABORTED:
        return _ABORT
    if ended in _CALLS:
        return f"execute called goal_handle.{_CALLS[ended]}(): look at what led there."
    return "Look at which terminal call (succeed, canceled, abort) execute makes on this path."


def error_name(goal: Goal) -> str:
    """Return the name of its result's error_code, '' if it has none."""
    result = goal.result.result if goal.result else None
    code = getattr(result, "error_code", None)
    return next((name for name in dir(type(result)) if name.isupper() and getattr(result, name) == code), "")


def lesson_on_the_end(goal: Goal) -> str:
    """Return the lesson on a goal that rclpy aborted by itself, '' (the check's) for any other."""
    return ABORTED_BY_RCLPY if goal.status == GoalStatus.ABORTED and why_rclpy_aborted(goal) else ""


def why_rclpy_aborted(goal: Goal) -> str | None:
    """Return why rclpy, and not execute, aborted the goal: it raised, or it made no terminal call. None: neither."""
    end = goal.result.t + IN_THE_LOG if goal.result else goal.run.end
    lines = [line.text for line in goal.run.all(ev.NodeOutput) if goal.sent.t <= line.t <= end]
    log = "\n".join(lines)
    if raised := re.search(r"Error raised in execute callback: *(.*)", log):
        place = raised_in(log)
        where = f" in {place}" if place else ""
        if transition := _FORBIDDEN.search(raised[1]):
            return _why_forbidden(where, *transition.groups())
        what = "".join(sign for sign in raised[1][:200] if sign.isprintable()) or "see the log"
        return (
            f"execute raised an exception{where}: {what}. rclpy then aborts the goal and "
            "sends an empty result."
        )
    if "Goal state not set, assuming aborted" in log:
        return (
            "execute returned without a terminal call, so rclpy aborted the goal: call goal_handle.succeed(), "
            "canceled() or abort() before `return result`."
        )
    return None


def _why_forbidden(where: str, state: str, event: str) -> str:
    """Return why rcl did not let the goal go from a state by an event."""
    if state not in ("EXECUTING", "CANCELING"):
        return f"execute made a second terminal call{where}: the goal was {state} already. Return after the first one."
    if event == "CANCELED":
        return (
            f"execute called goal_handle.canceled(){where}, but nobody had asked to cancel this goal, so rclpy aborted "
            "it. Call canceled() only when is_cancel_requested of this very goal is true."
        )
    return f"execute made a call{where} that a goal in state {state} does not allow, so rclpy aborted it."


def why_starved(goal: Goal) -> str | None:
    """Return what to do if execute keeps the node from being served: what it reports never changes while it runs."""
    distances = [getattr(feedback.feedback, "distance_remaining", None) for feedback in goal.feedback]
    if len(distances) < FROZEN or None in distances or len(set(distances)) > 1 or not _robot_moved(goal):
        return None
    return (
        f"distance_remaining stayed {distances[0]:.2f} m in all {len(distances)} feedback messages: no message of odom "
        "is served while execute holds the only thread. Use MultiThreadedExecutor, or an async execute that awaits."
    )


def _robot_moved(goal: Goal) -> bool:
    """Return whether the robot moved while feedback came."""
    first, last = goal.feedback[0].t, goal.feedback[-1].t
    seen = [robot for robot in goal.run.ground_truth if first <= robot.t <= last]
    return any(math.hypot(robot.x - seen[0].x, robot.y - seen[0].y) > MOVED for robot in seen)


def _why_it_never_came(goal: Goal) -> str:
    """Return why the result of a goal that has ended did not come."""
    if place := where_it_waited(goal.run):
        return f"execute has not returned since its terminal call: it stood in {place}. Return the result at once."
    if goal.run.first(ev.NodeStack):
        return (
            "Nothing of your node is served any more: a spin inside a callback, such as "
            "rclpy.spin_until_future_complete(self, …), takes the node away from its executor. Do not spin in execute."
        )
    return "The goal has ended, but execute returned no result: its last line must be `return result`."


def went_on(goal: Goal) -> bool:
    """Return whether feedback came until the scenario stopped waiting for the result."""
    given_up = goal.run.given_up("result", goal.name)
    end = given_up.t if given_up else goal.run.end
    return any(end - STILL_COMING <= feedback.t <= end for feedback in goal.feedback)


def why_no_result(goal: Goal) -> tuple[str, str]:
    """Return what was seen of a goal without a result, and what to do: by its last status and feedback."""
    status = goal.statuses[-1].status if goal.statuses else GoalStatus.UNKNOWN
    seen = f"no result; the goal's last status was {name_of(GoalStatus, status)}"
    if status in _CALLS:
        return seen, _why_it_never_came(goal)
    if status == GoalStatus.ACCEPTED:
        return seen, (
            "The goal is accepted and not executed: nobody called goal_handle.execute(). A handle_accepted_callback "
            "must call it, also for a goal that has to wait its turn."
        )
    if blind := why_starved(goal):
        return f"{seen}, and feedback still came", blind
    if went_on(goal):
        left = getattr(goal.feedback[-1].feedback, "distance_remaining", None)
        where = "" if left is None else f", {left:.2f} m from the goal"
        if status == GoalStatus.CANCELING:
            ends = "The cancel was accepted: look at goal_handle.is_cancel_requested in every round."
        elif left is not None and left > goal.feedback[0].feedback.distance_remaining + AWAY:
            ends = (
                "It goes away from it: cmd_vel is in base_link's axes, so turn the difference in x and y by minus the "
                "heading."
            )
        else:
            ends = "What ends it?"
        return f"{seen}, and feedback still came", f"execute is still in its loop{where}. {ends}"
    last = f"its last feedback came at {goal.feedback[-1].t:.1f} s" if goal.feedback else "without feedback"
    place = where_it_waited(goal.run)
    stood = f" It stood in {place}." if place else ""
    return f"{seen}, {last}", f"execute is still running: something in it waits without a time limit.{stood}"
