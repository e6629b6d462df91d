"""Chapter 7: cancel and preempt."""

from __future__ import annotations

import json
import math
from itertools import takewhile
from pathlib import Path
from typing import Any

from chapters.support import harness
from chapters.support.harness.recorded_turner import TERMINAL_CALLS
from humanoid_interfaces.action import WalkTo
from lab.client.exchange import wait_until
from lab.client.goals import Goal, send_goal
from lab.client.outcomes import Outcome
from lab.client.topics import mode, pose
from lab.client.waiting import becomes_true
from lab.errors import NodeEndedError, NoRobotError, NotInTimeError
from lab.learning.gap import Gap, expect, not_yet
from lab.learning.gap_check_helpers import last_error
from lab.running.robot import restart_robot, robot_process, start_robot
from lab.running.student_nodes import run_node

SERVER_PROGRAM = f"{harness.__path__[0]}/recorded_turner.py"
TERMINAL_STATUSES = ("SUCCEEDED", "CANCELED", "ABORTED")
NO_TERMINAL_CALL_WARNING = "Goal state not set, assuming aborted"  # rclpy's warning
READ_THE_LOG = "read the node's log: print(server.log())"
ACCEPT_TIMEOUT = 10.0  # s; the server rejects goals until it has received its first data
LOG_DELAY = 1.0  # s, until a line that the server printed before the status has been read
CANCEL_TIMEOUT = 5.0  # s; the robot needs 1 s of it to stand still
TURN_TIMEOUT = 15.0  # s


def canceled_when_the_robot_stands() -> str:
    """Cancel a turn in mid-step."""
    server = _start("cancellable_turn.py")
    goal = _send(server, 170)
    _wait_for_steps(server, goal, 3)
    goal.cancel()
    becomes_true(lambda: goal.status in TERMINAL_STATUSES or not server.is_running, CANCEL_TIMEOUT)
    if server.is_running and goal.status not in TERMINAL_STATUSES:
        raise not_yet(
            f"{CANCEL_TIMEOUT:g} s after the cancel the goal is still {goal.status}",
            "CANCELED as soon as the robot stands",
            "call goal_handle.canceled() when stand_still() has returned",
        )
    if goal.status == "CANCELED":
        _require_stand(server, "CANCELED")
    outcome = _outcome(server, goal, 1.0)
    expect(
        outcome.status == "CANCELED",
        seen=f"the goal ended {outcome.status}{server.error_in_log()}",
        expected="CANCELED",
        next="end the goal with one call of goal_handle.canceled()",
    )
    _require_filled(outcome, "result = self.result(first_step)")
    _require_order(server, "self.result(first_step)")
    _require_steps_at_the_end(server, outcome)
    expect(
        outcome.result.error_code == WalkTo.Result.NONE,
        seen=f"the goal ended CANCELED with error_code {outcome.result.error_code}",
        expected=f"error_code {WalkTo.Result.NONE}, NONE: the client asked for this end",
        next="fill the result with self.result(first_step), without a code",
    )
    return f"after {outcome.result.total_steps} steps: CANCELED, a robot that stands, and a filled result"


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
    server.forget_calls()
    sound = _outcome(server, _send(server, 20), TURN_TIMEOUT)
    expect(
        sound.status == "SUCCEEDED",
        seen=f"the goal of 20° ended {sound.status}{server.error_in_log()}",
        expected="SUCCEEDED for 20°, because no exception is raised",
        next="call goal_handle.succeed() after the result is filled, before you return it",
    )
    _require_stand(server, "SUCCEEDED")
    _require_filled(sound, "return the result of self.result_with_log(first_step)")
    _require_order(server, "self.result_with_log(first_step)")
    _require_steps_at_the_end(server, sound)
    return "0° ended ABORTED, so the client sees the bug; 20° ended SUCCEEDED with a filled result"


def aborts_the_older_goal() -> str:
    """Send a second goal in the middle of a turn."""
    server = _start("preemptable_turn.py")
    old = _send(server, 120)
    wait_until(lambda: len(old.feedback) > 4 or old.is_over or not server.is_running, TURN_TIMEOUT, "a turn")
    if old.is_over or not server.is_running:
        raise not_yet(
            f"the only goal ended {_outcome(server, old, 1.0).status}{server.error_in_log()}",
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
        seen=f"the older goal ended ABORTED with error_code {code}{server.error_in_log()}",
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
    _require_result_first(server, "self.result(first_step, …)")
    expect(
        "stop" not in server.calls_until_the_end(),
        seen="the robot was told to stop between the two goals",
        expected="a robot that keeps moving: the newer goal takes over the motion",
        next="leave self.stand_still() out of this branch",
    )
    second = _outcome(server, new, TURN_TIMEOUT)
    expect(
        second.status == "SUCCEEDED",
        seen=f"the newer goal ended {second.status}{server.error_in_log()}",
        expected="SUCCEEDED",
        next="end only the older goal in your branch",
    )
    return "the older goal ended ABORTED with error_code PREEMPTED, the newer one SUCCEEDED"


class _Server:
    """A student's server that runs while its calls are recorded."""

    def __init__(self, file: str) -> None:
        self._file = file
        self._forgotten = 0
        try:
            self._node = run_node(SERVER_PROGRAM, file)
        except NodeEndedError as problem:
            raise NodeEndedError(str(problem).replace(Path(SERVER_PROGRAM).name, file)) from None

    @property
    def is_running(self) -> bool:
        return self._node.is_running

    def log(self) -> str:
        return self._node.log()

    def error_in_log(self) -> str:
        """Return the last error or warning in the log as the end of a `seen` sentence; "" if there is none."""
        log = self.log()
        problem = last_error(log, self._file) or (
            NO_TERMINAL_CALL_WARNING if NO_TERMINAL_CALL_WARNING in log else ""
        )
        return f"; the node's log says: {problem}" if problem else ""

    def calls(self) -> list[dict[str, Any]]:
        """Return the recorded calls, without the forgotten ones."""
        lines = [line for line in self.log().splitlines() if line.startswith('{"call"')]
        return [json.loads(line) for line in lines[self._forgotten :]]

    def forget_calls(self) -> None:
        """Leave the calls until the end of this goal out of `calls()`."""
        becomes_true(lambda: self.end() is not None, LOG_DELAY)
        self._forgotten += len(self.calls())

    def end(self) -> dict[str, Any] | None:
        """Return the first terminal call; None if there is none."""
        return next((call for call in self.calls() if call["call"] in TERMINAL_CALLS), None)

    def calls_until_the_end(self) -> dict[str, dict[str, Any]]:
        """Return the last call of each name before the first terminal call."""
        before = takewhile(lambda call: call["call"] not in TERMINAL_CALLS, self.calls())
        return {call["call"]: call for call in before}


def _start(file: str) -> _Server:
    """Start the student's server while a robot stands."""
    try:
        robot_process()
    except NoRobotError:
        start_robot()
    if mode() == "FALLEN":
        restart_robot()
    wait_until(lambda: mode() == "STANDING", what="the robot stands")
    return _Server(file)


def _send(server: _Server, degrees: float) -> Goal:
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
            f"the server accepted no goal within {ACCEPT_TIMEOUT:g} s{server.error_in_log()}",
            "an accepted goal",
            READ_THE_LOG,
        )
    return sent[-1]


def _wait_for_steps(server: _Server, goal: Goal, count: int) -> None:
    """Wait for this many feedback messages, and until the robot walks and has made a step for this goal."""

    def under_way() -> bool:
        return len(goal.feedback) >= count and goal.feedback[-1].steps_taken > 0 and mode() == "WALKING"

    try:
        wait_until(lambda: under_way() or not server.is_running, TURN_TIMEOUT)
    except NotInTimeError:
        raise not_yet(
            f"the robot does not turn{server.error_in_log()}", "a turning robot", READ_THE_LOG
        ) from None


def _outcome(server: _Server, goal: Goal, seconds: float) -> Outcome:
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
        f"the node has ended without sending a result{server.error_in_log()}",
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


def _require_stand(server: _Server, status: str) -> None:
    """Require that the robot stood when the goal got this status."""
    becomes_true(lambda: server.end() is not None, LOG_DELAY)
    end = server.end()
    expect(
        end is None or not end["walking"],
        seen=f"the goal ended {status} while the robot was in mid-step",
        expected=f"{status} when the robot stands",
        next="call self.stand_still() first",
    )


def _require_order(server: _Server, fill: str) -> None:
    """Require that the student's lines filled the result before the terminal call, and when the robot stood."""
    _require_result_first(server, fill)
    filled = server.calls_until_the_end().get("result")
    expect(
        filled is None or not filled["walking"],
        seen=f"{fill} was called while the robot was in mid-step",
        expected="the pose and the steps of a robot that stands",
        next=f"call self.stand_still() first, then {fill}",
    )


def _require_result_first(server: _Server, fill: str) -> None:
    end, names = server.end(), [call["call"] for call in server.calls()]
    expect(
        end is None or "result" not in names or "result" in server.calls_until_the_end(),
        seen=f"{end and end['call']}() was called before {fill}",
        expected="a filled result before the terminal call",
        next=f"call {fill} first: if filling the result raises an exception, the goal must end ABORTED",
    )


def _require_steps_at_the_end(server: _Server, outcome: Outcome) -> None:
    """Require the steps that the robot had made at the terminal call, also of lines that don't call self.result()."""
    end, steps = server.end(), outcome.result.total_steps
    expect(
        end is None or steps == end["steps"],
        seen=f"total_steps {steps} in the result; the robot had made {end and end['steps']} steps when it stood",
        expected="the same number",
        next="fill the result when the robot stands",
    )


GAPS = (
    Gap("cancellable_turn.py", canceled_when_the_robot_stands),
    Gap("careful_turn.py", fills_the_result_before_the_terminal_call, duration=8),
    Gap("preemptable_turn.py", aborts_the_older_goal, duration=8),
)
