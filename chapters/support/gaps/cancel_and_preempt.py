"""Chapter 7: cancel and preempt."""

from __future__ import annotations

import math

from humanoid_interfaces.action import WalkTo
from lab.client.goals import Goal, send_goal
from lab.client.outcomes import Outcome
from lab.client.topics import mode, pose
from lab.client.waiting import becomes_true, wait_until
from lab.errors import NoRobotError, NotInTimeError
from lab.learning.gap import Gap, expect, not_yet
from lab.learning.gap_check_helpers import last_error
from lab.running.robot import restart_robot, robot_process, start_robot
from lab.running.student_nodes import StudentNode, run_node

TERMINAL_STATUSES = ("SUCCEEDED", "CANCELED", "ABORTED")
NO_TERMINAL_CALL_WARNING = "Goal state not set, assuming aborted"  # rclpy's warning
READ_THE_LOG = "read the node's log: print(server.log())"
ACCEPT_TIMEOUT = 10.0  # s; the server rejects goals until it has received its first data
MODE_DELAY = 0.1  # s, until a robot_state that was published before the status has been handled
CANCEL_TIMEOUT = 5.0  # s; the robot needs 1 s of it to stand still
TURN_TIMEOUT = 15.0  # s


def canceled_when_the_robot_stands() -> str:
    """Cancel two turns in mid-step.

    One cancel is not enough: in some phases of a step the robot stands almost at once, even with wrong lines.
    """
    server = _start("cancellable_turn.py")
    steps = [_cancel_in_mid_step(server, feedback_count) for feedback_count in (3, 6)]
    return f"after {steps[0]} and {steps[1]} steps: CANCELED, a robot that stands, and a filled result"


def _cancel_in_mid_step(server: StudentNode, feedback_count: int) -> int:
    """Cancel a turn after this many feedback messages, and return the steps in its result."""
    goal = _send(server, 170)
    _wait_for_steps(server, goal, feedback_count)
    goal.cancel()
    becomes_true(lambda: goal.status in TERMINAL_STATUSES or not server.is_running, CANCEL_TIMEOUT)
    stands = becomes_true(lambda: mode() == "STANDING", MODE_DELAY)
    if server.is_running and goal.status not in TERMINAL_STATUSES:
        raise not_yet(
            f"{CANCEL_TIMEOUT:g} s after the cancel the goal is still {goal.status}",
            "CANCELED as soon as the robot stands",
            "call goal_handle.canceled() when stand_still() has returned",
        )
    expect(
        goal.status != "CANCELED" or stands,
        seen="the goal ended CANCELED while the robot was in mid-step",
        expected="CANCELED when the robot stands",
        next="call self.stand_still() first",
    )
    outcome = _outcome(server, goal, 1.0)
    expect(
        outcome.status == "CANCELED",
        seen=f"the goal ended {outcome.status}{_error_in_log(server)}",
        expected="CANCELED",
        next="end the goal with one call of goal_handle.canceled()",
    )
    _require_filled(outcome, "result = self.result(first_step)")
    return int(outcome.result.total_steps)


def fills_the_result_before_the_terminal_call() -> str:
    """Send a goal of 0°, for which filling the result raises an exception, then one of 20°."""
    server = _start("careful_turn.py")
    with_bug = _outcome(server, _send(server, 0), TURN_TIMEOUT)
    if with_bug.status == "SUCCEEDED" and with_bug.result.final_pose.header.frame_id:
        raise not_yet(
            "the goal of 0° ended SUCCEEDED with a filled result",
            "ABORTED, because result_with_log() raises an exception for 0°",
            "fill the result with self.result_with_log(first_step)",
        )
    expect(
        with_bug.status == "ABORTED",
        seen=f"the goal of 0° ended {with_bug.status} with an empty result, although filling it raised an exception",
        expected="ABORTED for 0°",
        next="fill the result first, then make the terminal call, because that call decides the status",
    )
    sound = _outcome(server, _send(server, 20), TURN_TIMEOUT)
    stands = becomes_true(lambda: mode() == "STANDING", MODE_DELAY)
    expect(
        sound.status == "SUCCEEDED",
        seen=f"the goal of 20° ended {sound.status}{_error_in_log(server)}",
        expected="SUCCEEDED for 20°, because no exception is raised",
        next="call goal_handle.succeed() after the result is filled, before you return it",
    )
    expect(
        stands,
        seen="the goal of 20° ended SUCCEEDED while the robot was in mid-step",
        expected="SUCCEEDED when the robot stands",
        next="call self.stand_still() first",
    )
    _require_filled(sound, "return the result of self.result_with_log(first_step)")
    return "0° ended ABORTED, so the client sees the bug; 20° ended SUCCEEDED with a filled result"


def aborts_the_older_goal() -> str:
    """Send a second goal in the middle of a turn."""
    server = _start("preemptable_turn.py")
    old = _send(server, 120)
    wait_until(lambda: len(old.feedback) > 4 or old.is_over or not server.is_running, TURN_TIMEOUT, "a turn")
    if old.is_over or not server.is_running:
        raise not_yet(
            f"the only goal ended {_outcome(server, old, 1.0).status}{_error_in_log(server)}",
            "the goal stays active until a newer one is accepted",
            "end the goal only if self.newest is another goal than goal_handle",
        )
    new = _send(server, -40)
    if not becomes_true(lambda: old.is_over or not server.is_running, 2.0):
        raise not_yet(
            f"2 s after the second goal was accepted, the first one is still {old.status}",
            "ABORTED in the next round of its loop",
            "compare self.newest with goal_handle; if they differ, end the goal and return its result",
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
        seen=f"the older goal ended ABORTED with error_code {code}{_error_in_log(server)}",
        expected=f"error_code {WalkTo.Result.PREEMPTED}, PREEMPTED",
        next='call abort() once, and return self.result(first_step, WalkTo.Result.PREEMPTED, "…"); '
        "no cancel was requested, so canceled() raises an exception",
    )
    expect(
        first.result.error_msg,
        seen="the older goal ended with error_code PREEMPTED and an empty error_msg",
        expected="an error_msg for people",
        next="give self.result() a third argument that says why the goal ended",
    )
    expect(
        NO_TERMINAL_CALL_WARNING not in server.log(),
        seen=f"rclpy aborted the older goal, because your lines made no terminal call: {NO_TERMINAL_CALL_WARNING}",
        expected="a terminal call in your lines",
        next="call goal_handle.abort() before you return the result",
    )
    second = _outcome(server, new, TURN_TIMEOUT)
    expect(
        second.status == "SUCCEEDED",
        seen=f"the newer goal ended {second.status}{_error_in_log(server)}",
        expected="SUCCEEDED",
        next="end only the older goal in your branch",
    )
    return "the older goal ended ABORTED with error_code PREEMPTED, the newer one SUCCEEDED"


def _start(file: str) -> StudentNode:
    """Start the student's server while a robot stands."""
    try:
        robot_process()
    except NoRobotError:
        start_robot()
    if mode() == "FALLEN":
        restart_robot()
    wait_until(lambda: mode() == "STANDING", what="the robot stands")
    return run_node(file)


def _send(server: StudentNode, degrees: float) -> Goal:
    """Send a turn by this angle; repeat it until the server accepts it."""
    sent: list[Goal] = []

    def accepted() -> bool:
        yaw = pose().yaw + math.radians(degrees)
        goal = WalkTo.Goal()
        goal.target_pose.header.frame_id = "odom"
        goal.target_pose.pose.orientation.z = math.sin(yaw / 2)
        goal.target_pose.pose.orientation.w = math.cos(yaw / 2)
        sent.append(send_goal("turn_to", WalkTo, goal))
        return sent[-1].accepted

    if not becomes_true(accepted, ACCEPT_TIMEOUT):
        raise not_yet(
            f"the server accepted no goal within {ACCEPT_TIMEOUT:g} s{_error_in_log(server)}",
            "an accepted goal",
            READ_THE_LOG,
        )
    return sent[-1]


def _wait_for_steps(server: StudentNode, goal: Goal, count: int) -> None:
    """Wait for this many feedback messages, and until the robot walks and has made a step for this goal."""

    def under_way() -> bool:
        return len(goal.feedback) >= count and goal.feedback[-1].steps_taken > 0 and mode() == "WALKING"

    try:
        wait_until(lambda: under_way() or not server.is_running, TURN_TIMEOUT)
    except NotInTimeError:
        raise not_yet(
            f"the robot does not turn{_error_in_log(server)}", "a turning robot", READ_THE_LOG
        ) from None


def _outcome(server: StudentNode, goal: Goal, seconds: float) -> Outcome:
    """Return how the goal ended.

    Raises GapError if it has not ended in time, or if the node exited before it sent the result.
    """
    becomes_true(lambda: goal.is_over or not server.is_running, seconds)
    if goal.is_over:
        return goal.result(show_feedback=False)
    if server.is_running:
        over = goal.status in TERMINAL_STATUSES
        advice = (
            "end the branch with `return result`"
            if over
            else "end each path with a terminal call and a return"
        )
        raise not_yet(f"the goal is {goal.status}, but no result has arrived", "a result", advice)
    raise not_yet(
        f"the node has ended without sending a result{_error_in_log(server)}",
        "a result",
        "end the path with `return result`",
    )


def _require_filled(outcome: Outcome, advice: str) -> None:
    result = outcome.result
    expect(
        result.final_pose.header.frame_id == "odom" and result.total_steps > 0,
        seen=f"the result has final_pose in frame {result.final_pose.header.frame_id!r} and total_steps "
        f"{result.total_steps}",
        expected="final_pose in frame 'odom', and total_steps of this turn",
        next=advice,
    )


def _error_in_log(server: StudentNode) -> str:
    """Return the last error or warning in the node's log as the end of a `seen` sentence; "" if there is none."""
    log = server.log()
    problem = last_error(log, server.file.name) or (
        NO_TERMINAL_CALL_WARNING if NO_TERMINAL_CALL_WARNING in log else ""
    )
    return f"; the node's log says: {problem}" if problem else ""


GAPS = (
    Gap("cancellable_turn.py", canceled_when_the_robot_stands),
    Gap("careful_turn.py", fills_the_result_before_the_terminal_call),
    Gap("preemptable_turn.py", aborts_the_older_goal),
)
