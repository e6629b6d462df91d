"""Why a goal ended with a wrong status or not at all, and what to do, from its status, its feedback and the log."""

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
    from autograder.authoring.evidence.transcript import Transcript

LOOP_TIME = 1.5  # s; if the last feedback is not older, execute is still in its loop
MIN_FROZEN = 10  # feedback messages; so many with the same distance are no coincidence while the robot moves
MOVED_DISTANCE = 0.05  # m
AWAY_DISTANCE = 0.5  # m farther from the goal than at first
STARVED_LESSON = "05_executors#one-why"
LOG_DELAY = 0.5  # s by which a line of the log may come after the result that it explains
_CALLS: dict[int, str] = {
    GoalStatus.SUCCEEDED: "succeed",
    GoalStatus.CANCELED: "canceled",
    GoalStatus.ABORTED: "abort",
}
_CANCELED_INSTEAD: dict[int, str] = {
    GoalStatus.SUCCEEDED: "An accepted cancel ends with goal_handle.canceled(), not succeed(): check "
    "is_cancel_requested in every round.",
    GoalStatus.ABORTED: "Once is_cancel_requested is seen, stop the robot, call goal_handle.canceled() and return.",
}
_FORBIDDEN = re.compile(r"invalid transition from state (\w+) with event (\w+)")
ABORTED_BY_RCLPY = "06_walk_to_a_pose#move-why"
_ABORT = "Call goal_handle.abort(), with the reason in result.error_code, when the goal cannot be reached any more."


def why_it_ended_so(goal: Goal, wanted: int) -> str:
    """Return what to do about a goal that ended with another status than `wanted`."""
    last = goal.result or final_status(goal)
    ended = last.status if last else GoalStatus.UNKNOWN
    if ended == GoalStatus.ABORTED and (unmeant := why_rclpy_aborted(goal)):
        return unmeant
    code = error_name(goal)
    if wanted == GoalStatus.CANCELED and ended == GoalStatus.ABORTED and code not in ("", "NONE"):
        return (
            f"After the cancel your server aborted the goal with {code}, because its reaction to the cancel failed. "
            "Bring robot and object to a safe state, and then call goal_handle.canceled()."
        )
    if wanted == GoalStatus.CANCELED and ended in _CANCELED_INSTEAD:
        return _CANCELED_INSTEAD[ended]
    if wanted == GoalStatus.ABORTED:
        return _ABORT
    if ended in _CALLS:
        return f"execute called goal_handle.{_CALLS[ended]}(): check the condition before this call."
    return "Check which terminal call (succeed, canceled, abort) execute makes on this path."


def final_status(goal: Goal) -> ev.StatusSeen | None:
    """Return when the goal was last seen in a final status, with or without a result; None: it never was."""
    last = goal.statuses[-1] if goal.statuses else None
    return last if last and last.status in _CALLS else None


def error_name(goal: Goal) -> str:
    """Return the name of its result's error_code, '' if it has none."""
    result = goal.result.result if goal.result else None
    code = getattr(result, "error_code", None)
    return next((name for name in dir(type(result)) if name.isupper() and getattr(result, name) == code), "")


def how_goals_ended(run: Transcript) -> str:
    """Return how long after its acceptance each goal of a run ended, and how, in words; '' if none did."""
    return "; ".join(
        f"the goal “{goal.name}” was {name_of(GoalStatus, goal.result.status)} "
        f"{max(0.0, goal.result.t - goal.answer.t):.1f} s after its acceptance"
        for goal in run.goals
        if goal.answer and goal.answer.accepted and goal.result
    )


def lesson_on_the_end(goal: Goal) -> str:
    """Return the lesson on a goal that rclpy aborted by itself, '' (the check's) for any other."""
    return ABORTED_BY_RCLPY if goal.status == GoalStatus.ABORTED and why_rclpy_aborted(goal) else ""


def why_rclpy_aborted(goal: Goal) -> str | None:
    """Return why rclpy aborted the goal: execute raised, or made no terminal call. None: rclpy did not abort it."""
    end = goal.result.t + LOG_DELAY if goal.result else goal.run.end
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
    """Return what to do about a state transition that rcl rejected."""
    if state not in ("EXECUTING", "CANCELING"):
        return f"execute made a second terminal call{where}: the goal was {state} already. Return after the first one."
    if event == "CANCELED":
        return (
            f"execute called goal_handle.canceled(){where}, but no cancel of this goal was requested, so rclpy aborted "
            "it. Call canceled() only when is_cancel_requested of this very goal is true."
        )
    return f"execute made a call{where} that a goal in state {state} does not allow, so rclpy aborted it."


def why_starved(goal: Goal) -> str | None:
    """Return what to do if execute blocks all callbacks, so that its feedback never changes while the robot moves."""
    distances = [getattr(feedback.feedback, "distance_remaining", None) for feedback in goal.feedback]
    if len(distances) < MIN_FROZEN or None in distances or len(set(distances)) > 1 or not _robot_moved(goal):
        return None
    return (
        f"distance_remaining stayed {distances[0]:.2f} m in all {len(distances)} feedback messages: the callback of "
        "odom never runs while execute occupies the only thread. Use MultiThreadedExecutor, or an async execute that "
        "awaits."
    )


def _robot_moved(goal: Goal) -> bool:
    """Return whether the robot moved between the first and the last feedback."""
    first, last = goal.feedback[0].t, goal.feedback[-1].t
    seen = [robot for robot in goal.run.ground_truth if first <= robot.t <= last]
    return any(math.hypot(robot.x - seen[0].x, robot.y - seen[0].y) > MOVED_DISTANCE for robot in seen)


def _why_no_result_after_the_end(goal: Goal) -> str:
    """Return why a goal reached a final status, but sent no result."""
    if place := where_it_waited(goal.run):
        return f"execute made its terminal call but has not returned: it was blocked in {place}. Return the result."
    if goal.run.first(ev.NodeStack):
        return (
            "No callback of your node runs any more: a spin inside a callback, such as "
            "rclpy.spin_until_future_complete(self, …), removes the node from its executor. Do not spin in execute."
        )
    return "The goal has ended, but execute returned no result: its last line must be `return result`."


def went_on(goal: Goal) -> bool:
    """Return whether feedback was still coming when the scenario stopped waiting for the result."""
    given_up = goal.run.given_up("result", goal.name)
    end = given_up.t if given_up else goal.run.end
    return any(end - LOOP_TIME <= feedback.t <= end for feedback in goal.feedback)


def why_no_result(goal: Goal) -> tuple[str, str]:
    """Return what was observed of a goal without a result, and what to do, by its last status and feedback."""
    status = goal.statuses[-1].status if goal.statuses else GoalStatus.UNKNOWN
    seen = f"no result; the goal's last status was {name_of(GoalStatus, status)}"
    end, given_up = final_status(goal), goal.run.given_up("result", goal.name)
    if end and given_up and end.t > given_up.t:
        ended = f"the goal ended {name_of(GoalStatus, end.status)} {end.t - given_up.t:.1f} s later"
        return (
            f"no result within {given_up.waited:.0f} s; {ended}",
            "It takes too long: look for what it waits for.",
        )
    if status in _CALLS:
        return seen, _why_no_result_after_the_end(goal)
    if status == GoalStatus.ACCEPTED:
        return seen, (
            "The goal was accepted but never executed: a handle_accepted_callback must call goal_handle.execute(), "
            "also for a goal that has to wait for another."
        )
    if starved := why_starved(goal):
        return f"{seen}, and feedback still came", starved
    if went_on(goal):
        left = getattr(goal.feedback[-1].feedback, "distance_remaining", None)
        where = "" if left is None else f", {left:.2f} m from the goal"
        if status == GoalStatus.CANCELING:
            advice = "The cancel was accepted: check goal_handle.is_cancel_requested in every round."
        elif left is not None and left > goal.feedback[0].feedback.distance_remaining + AWAY_DISTANCE:
            advice = (
                "The robot moves away from the goal: cmd_vel is in base_link's axes, so rotate the difference in x and "
                "y by minus the heading."
            )
        else:
            advice = "Check the condition that ends the loop."
        return f"{seen}, and feedback still came", f"execute is still in its loop{where}. {advice}"
    last = f"its last feedback came at {goal.feedback[-1].t:.1f} s" if goal.feedback else "without feedback"
    place = where_it_waited(goal.run)
    blocked = f" It was blocked in {place}." if place else ""
    return f"{seen}, {last}", f"execute is still running: something in it waits without a timeout.{blocked}"
