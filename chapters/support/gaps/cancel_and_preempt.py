"""Chapter 7: cancel and preempt."""

from __future__ import annotations

import math

from humanoid_interfaces.action import WalkTo
from lab.client.goals import Goal, send_goal
from lab.client.outcomes import Outcome
from lab.client.topics import mode, pose
from lab.client.waiting import comes_true, wait_until
from lab.errors import NoRobotError, NotInTimeError
from lab.learning.gap import Gap, expect, not_yet
from lab.learning.gap_check_helpers import last_error
from lab.running.robot import restart_robot, robot_process, start_robot
from lab.running.student_nodes import StudentNode, run_node

TERMINAL_STATUSES = ("SUCCEEDED", "CANCELED", "ABORTED")
NO_TERMINAL_CALL_WARNING = "Goal state not set, assuming aborted"  # rclpy's warning
ACCEPT_TIMEOUT = 10.0  # s; until then the server rejects goals
MODE_DELAY = 0.1  # s for the change of mode that came before the status to be handled
CANCEL_TIMEOUT = 5.0  # s; standing still takes one of them
TURN_TIMEOUT = 15.0  # s for the turns of these checks


def canceled_when_the_robot_stands() -> str:
    """Cancel two turns in mid-step; from some phases of a step the robot stands almost at once."""
    server = _start("cancellable_turn.py")
    steps = [_cancel_in_mid_step(server, after) for after in (3, 6)]
    return f"twice CANCELED with the robot STANDING, after {steps[0]} and {steps[1]} steps, and the result is filled"


def _cancel_in_mid_step(server: StudentNode, after: int) -> int:
    """Cancel a turn after so many feedback messages, and return the steps in its result."""
    goal = _send(server, 170)
    _wait_for_steps(server, goal, after)
    goal.cancel()
    comes_true(lambda: goal.status in TERMINAL_STATUSES or not server.is_running, CANCEL_TIMEOUT)
    stands = comes_true(lambda: mode() == "STANDING", MODE_DELAY)
    if server.is_running and goal.status not in TERMINAL_STATUSES:
        raise not_yet(
            f"status {goal.status} {CANCEL_TIMEOUT:g} s after the cancel",
            "CANCELED as soon as the robot stands",
            "call goal_handle.canceled() when stand_still() has returned",
        )
    expect(
        goal.status != "CANCELED" or stands,
        seen="CANCELED while the robot was in mid-step",
        expected="a robot that stands when CANCELED comes",
        next="call self.stand_still() first",
    )
    outcome = _outcome(server, goal, 1.0)
    expect(
        outcome.status == "CANCELED",
        seen=f"status {outcome.status}{_complaint(server)}",
        expected="CANCELED",
        next="end the goal with goal_handle.canceled(), once",
    )
    _require_filled(outcome, "result = self.result(first_step)")
    return int(outcome.result.total_steps)


def a_bug_ends_aborted() -> str:
    """Send a goal of 0°, in which filling the result raises, then one of 20°."""
    server = _start("careful_turn.py")
    with_bug = _outcome(server, _send(server, 0), TURN_TIMEOUT)
    if with_bug.status == "SUCCEEDED" and with_bug.result.final_pose.header.frame_id:
        raise not_yet(
            "0°: SUCCEEDED with a filled result, so nothing raised",
            "ABORTED: the bug stays for now",
            "fill the result with self.result_with_log(first_step)",
        )
    expect(
        with_bug.status == "ABORTED",
        seen=f"0°: {with_bug.status} with an empty result, although filling it raised",
        expected="0°: ABORTED",
        next="fill the result first; the terminal call decides the status, so it comes after that",
    )
    sound = _outcome(server, _send(server, 20), TURN_TIMEOUT)
    stands = comes_true(lambda: mode() == "STANDING", MODE_DELAY)
    expect(
        sound.status == "SUCCEEDED",
        seen=f"0°: ABORTED, and 20°: {sound.status}{_complaint(server)}",
        expected="20°: SUCCEEDED, because there nothing raises",
        next="call goal_handle.succeed() after the result is filled, before you return it",
    )
    expect(
        stands,
        seen="20°: SUCCEEDED while the robot was in mid-step",
        expected="a robot that stands",
        next="call self.stand_still() first",
    )
    _require_filled(sound, "return what self.result_with_log(first_step) gave you")
    return "0° ended ABORTED, so the bug shows; 20° ended SUCCEEDED with a filled result"


def the_newest_goal_wins() -> str:
    """Send a second goal in the middle of a turn."""
    server = _start("preemptable_turn.py")
    old = _send(server, 120)
    wait_until(lambda: len(old.feedback) > 4 or old.is_over or not server.is_running, TURN_TIMEOUT, "a turn")
    if old.is_over or not server.is_running:
        raise not_yet(
            f"the only goal ended {_outcome(server, old, 1.0).status}{_complaint(server)}",
            "a goal that goes on until there is a newer one",
            "give way only if self.newest is another goal than goal_handle",
        )
    new = _send(server, -40)
    if not comes_true(lambda: old.is_over or not server.is_running, 2.0):
        raise not_yet(
            f"2 s after the second goal the first is still {old.status}",
            "ABORTED in its next round",
            "compare self.newest with goal_handle, end the goal, and return its result",
        )
    first = _outcome(server, old, 1.0)
    expect(
        first.status == "ABORTED",
        seen=f"the older goal ended {first.status}",
        expected="ABORTED",
        next="end it with goal_handle.abort()",
    )
    code = first.result.error_code
    expect(
        code == WalkTo.Result.PREEMPTED,
        seen=f"ABORTED with error_code {code}{_complaint(server)}",
        expected=f"error_code {WalkTo.Result.PREEMPTED}, PREEMPTED",
        next='return self.result(first_step, WalkTo.Result.PREEMPTED, "…") after one call of abort(): '
        "no cancel was requested, so canceled() raises",
    )
    expect(
        first.result.error_msg,
        seen="PREEMPTED with an empty error_msg",
        expected="a sentence for people",
        next="give self.result() a third argument that says why the goal ended",
    )
    expect(
        NO_TERMINAL_CALL_WARNING not in server.log(),
        seen=f"ABORTED, but rclpy had to do it: {NO_TERMINAL_CALL_WARNING}",
        expected="your terminal call",
        next="call goal_handle.abort() before you return the result",
    )
    second = _outcome(server, new, TURN_TIMEOUT)
    expect(
        second.status == "SUCCEEDED",
        seen=f"the newer goal ended {second.status}{_complaint(server)}",
        expected="SUCCEEDED",
        next="end only the older goal in your branch",
    )
    return "the older goal ended ABORTED with PREEMPTED, the newer one SUCCEEDED"


def _start(file: str) -> StudentNode:
    """Start a server beside a robot that stands."""
    try:
        robot_process()
    except NoRobotError:
        start_robot()
    if mode() == "FALLEN":
        restart_robot()
    wait_until(lambda: mode() == "STANDING", what="the robot stands")
    return run_node(file)


def _send(server: StudentNode, degrees: float) -> Goal:
    """Send a turn from where the robot faces now, again and again until the server accepts it."""
    sent: list[Goal] = []

    def accepted() -> bool:
        yaw = pose().yaw + math.radians(degrees)
        goal = WalkTo.Goal()
        goal.target_pose.header.frame_id = "odom"
        goal.target_pose.pose.orientation.z = math.sin(yaw / 2)
        goal.target_pose.pose.orientation.w = math.cos(yaw / 2)
        sent.append(send_goal("turn_to", WalkTo, goal))
        return sent[-1].accepted

    if not comes_true(accepted, ACCEPT_TIMEOUT):
        raise not_yet(f"no goal was accepted{_complaint(server)}", "an accepted goal", "look at server.log()")
    return sent[-1]


def _wait_for_steps(server: StudentNode, goal: Goal, count: int) -> None:
    """Wait until so many feedback messages have come, the robot is in mid-turn and has made a step for this goal."""

    def under_way() -> bool:
        return len(goal.feedback) >= count and goal.feedback[-1].steps_taken > 0 and mode() == "WALKING"

    try:
        wait_until(lambda: under_way() or not server.is_running, TURN_TIMEOUT)
    except NotInTimeError:
        raise not_yet(
            f"the robot does not turn{_complaint(server)}", "a turn", "look at server.log()"
        ) from None


def _outcome(server: StudentNode, goal: Goal, seconds: float) -> Outcome:
    """Return how the goal ended.

    Raises GapError when it did not, or without a result because the node ended.
    """
    comes_true(lambda: goal.is_over or not server.is_running, seconds)
    if goal.is_over:
        return goal.result(show_feedback=False)
    if server.is_running:
        over = goal.status in TERMINAL_STATUSES
        advice = (
            "end the branch with `return result`"
            if over
            else "end each path with a terminal call and a return"
        )
        raise not_yet(f"status {goal.status}, but no result", "the result", advice)
    raise not_yet(
        f"no result: the node has ended{_complaint(server)}", "a result", "end the path with `return result`"
    )


def _require_filled(outcome: Outcome, advice: str) -> None:
    result = outcome.result
    expect(
        result.final_pose.header.frame_id == "odom" and result.total_steps > 0,
        seen=f"a result with frame {result.final_pose.header.frame_id!r} and {result.total_steps} steps",
        expected="the final pose in 'odom', and the steps of this turn",
        next=advice,
    )


def _complaint(server: StudentNode) -> str:
    """Return the last error or warning in the node's log, to put behind what was seen."""
    log = server.log()
    problem = last_error(log, server.file.name) or (
        NO_TERMINAL_CALL_WARNING if NO_TERMINAL_CALL_WARNING in log else ""
    )
    return f"; its log says: {problem}" if problem else ""


GAPS = (
    Gap("cancellable_turn.py", canceled_when_the_robot_stands),
    Gap("careful_turn.py", a_bug_ends_aborted),
    Gap("preemptable_turn.py", the_newest_goal_wins),
)
