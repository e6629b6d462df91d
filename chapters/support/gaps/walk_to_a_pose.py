"""Chapter 6: walk to a pose."""

from __future__ import annotations

import json
from itertools import pairwise
from statistics import median
from typing import Any

from chapters.support import harness
from chapters.support.harness.goal_server import REASON, STEPS
from lab.learning.gap import Gap, expect, not_yet
from lab.learning.gap_check_helpers import last_error_or_line
from lab.running.programs import run_program
from lab.running.student_nodes import run_node

TRIALS_PROGRAM = f"{harness.__path__[0]}/walk_callbacks.py"
SERVER_PROGRAM = f"{harness.__path__[0]}/goal_server.py"
TRIAL_TIMEOUT = 40.0  # s; correct lines need up to 6 s
TOLERANCE = 0.10  # m, the same as in the chapter's file
GOAL = 0.5  # m ahead, in the trial
PERIOD, MIN_PERIOD, MAX_PERIOD = 0.2, 0.1, 0.35  # s between feedback messages: required, least and most
MAX_FEEDBACK_ERROR = 0.07  # m; a command moves the toy robot by 0.06 m
FAILURES = ("ABORTED", "CANCELED", "UNKNOWN")
TO_ACCEPT = ("1 m in base_link, while the robot stands", "3 m in base_link, while the robot stands")
ADVICE = {
    "1 m in base_link, while the robot stands": "end with `return GoalResponse.ACCEPT` for a valid goal",
    "3 m in base_link, while the robot stands": "FARTHEST itself is still allowed: use <=",
    "a goal before the first odom": "reject while self.pose is None, before you check anything else",
    "a goal before the first robot_state": "reject while self.state is None, before you read self.state.mode",
    "a goal while the robot walks": "accept only when self.state.mode == RobotState.STANDING",
    "a goal while the robot lies on the floor": "accept only when self.state.mode == RobotState.STANDING",
    "a goal while the motors are off": "accept only when self.state.mode == RobotState.STANDING",
    "1 m in frame odom": 'compare goal.target_pose.header.frame_id with "base_link"',
    "1 m without a frame": 'an empty frame is not "base_link": reject every other frame',
    "-1 m": "reject unless position.x is above 0",
    "0 m": "reject unless position.x is above 0: use <, not <=",
    "3.5 m": "reject unless position.x is at most FARTHEST",
    "NaN m": "accept only if 0.0 < x <= FARTHEST, which is false for NaN; or test math.isfinite(x)",
}


def rejects_what_cannot_work() -> str:
    """Call the goal callback with thirteen goals."""
    trials = _trial("goals")
    for trial in trials:
        case, returned = trial["case"], trial["returned"]
        wanted = "ACCEPT" if case in TO_ACCEPT else "REJECT"
        if returned == "None":
            raise not_yet(
                f"{case}: the callback returned nothing",
                f"GoalResponse.{wanted}",
                "end every path with a return",
            )
        expect(
            returned in ("ACCEPT", "REJECT") or "Error" in returned,
            seen=f"{case}: the callback returned {returned}",
            expected=f"GoalResponse.{wanted}",
            next="return GoalResponse.ACCEPT or GoalResponse.REJECT: rclpy treats any other value as a rejection",
        )
        expect(
            returned == wanted,
            seen=f"{case}: {returned}",
            expected=f"GoalResponse.{wanted}",
            next="fix the error that is named here"
            if "Error" in returned and "NoneType" not in returned
            else ADVICE[case],
        )
    return f"it accepted {len(TO_ACCEPT)} goals and rejected {len(trials) - len(TO_ACCEPT)}"


def measures_after_the_robot_stands() -> str:
    """Walk a toy robot half a metre; it is pushed back when it stops for the first time."""
    (seen,) = _trial("settling")
    returned, ended = seen["returned"], seen["ended"]
    if "had not ended" in returned and ended:
        raise not_yet(
            "the loop goes on after it has ended the goal",
            "no command after the terminal call",
            "return the result right after the terminal call",
        )
    if "had not ended" in returned:
        raise not_yet(
            "the loop never ends the goal",
            "SUCCEEDED as soon as the robot stands within TOLERANCE",
            "compare the absolute value: abs(self.distance_left(goal_handle, start)) <= TOLERANCE",
        )
    expect(
        "Error" not in returned,
        seen=f"execute raised {returned}",
        expected="no exception, and the result",
        next="return the result right after the terminal call"
        if "after succeed" in returned
        else "fix the error that is named here",
    )
    expect(
        ended,
        seen="execute returned without a terminal call",
        expected="a call of goal_handle.succeed()",
        next="call goal_handle.succeed() before you return the result",
    )
    expect(
        ended[0] == "succeed",
        seen="the goal was aborted",
        expected="another approach, then goal_handle.succeed()",
        next="if the robot is not within TOLERANCE, do nothing: the loop calls approach() again",
    )
    expect(
        ended[1] == "standing",
        seen="the goal ended SUCCEEDED while the robot was in mid-step",
        expected="SUCCEEDED when the robot stands",
        next="call self.stand_still() first",
    )
    expect(
        abs(seen["final"] - GOAL) <= TOLERANCE,
        seen=f"the goal ended SUCCEEDED although the robot stands {abs(seen['final'] - GOAL):.2f} m from it",
        expected=f"another approach, because the distance is more than {TOLERANCE:.2f} m",
        next="measure the distance after stand_still(), and call succeed() only if it is within TOLERANCE",
    )
    expect(
        returned.startswith("a result"),
        seen=f"the goal ended SUCCEEDED, but execute returned {returned}",
        expected="the result",
        next="end with `return result`",
    )
    expect(
        returned == f"a result with final_pose {seen['final']:.2f}",
        seen=f"execute returned {returned}, but the robot stands at {seen['final']:.2f}",
        expected="the pose at which the robot stands, in final_pose",
        next="call self.result(start) after stand_still()",
    )
    expect(
        not seen["filled_late"],
        seen="succeed() was called before self.result(start)",
        expected="a filled result before the terminal call",
        next="call self.result(start) before goal_handle.succeed(): if filling the result raises an exception, the "
        "goal must not end SUCCEEDED",
    )
    return (
        "the robot was pushed back and walked again; the goal ended SUCCEEDED when it stood within TOLERANCE"
    )


def publishes_feedback() -> str:
    """Receive the feedback while a toy robot walks half a metre, is pushed back, and walks again."""
    (seen,) = _trial("feedback")
    returned, messages = seen["returned"], seen["feedback"]
    expect(
        "Error" not in returned,
        seen=f"execute raised {returned}",
        expected="no exception, and the result",
        next="fix the error that is named here",
    )
    expect(
        len(messages) > 1,
        seen=f"{'one' if messages else 'no'} feedback message in the whole walk",
        expected=f"a feedback message every {PERIOD} s",
        next="call goal_handle.publish_feedback(feedback) in each round, not only in the last",
    )
    _require_five_a_second([each["t"] for each in messages])
    _require_measured(messages, seen["steps"])
    last = messages[-1]
    expect(
        last["robot_stands"] and abs(last["robot_x"] - GOAL) <= TOLERANCE,
        seen=f"the last feedback came {abs(last['robot_x'] - GOAL):.2f} m from the goal, before the robot stood",
        expected="a feedback message when the robot stands at the goal, before succeed()",
        next="publish in the last round, too: don't skip it when `arrived` is true",
    )
    expect(
        returned.startswith("a result") and seen["ended"][:1] == ["succeed"],
        seen=f"execute returned {returned} after {' '.join(seen['ended'][:1]) or 'no terminal call'}",
        expected="execute returns the result after succeed()",
        next="don't leave the loop in your lines: the lines below the loop end the goal",
    )
    return f"{len(messages)} feedback messages, five a second; the last one has the pose at which the robot stands"


def _require_five_a_second(times: list[float]) -> None:
    """Require that the median time between messages is about PERIOD; one message may be late when the robot stops."""
    usual = median(after - before for before, after in pairwise(times))
    expect(
        usual <= MAX_PERIOD,
        seen=f"a message every {usual:.1f} s: {1 / usual:.1g} Hz",
        expected=f"a message every {PERIOD} s",
        next="wait once in each round, for PERIOD",
    )
    expect(
        usual >= MIN_PERIOD,
        seen=f"a message every {1000 * usual:.0f} ms",
        expected=f"a message every {PERIOD} s",
        next="wait after each message with time.sleep(PERIOD): a client keeps the last ten only",
    )


def _require_measured(messages: list[dict[str, Any]], steps: int) -> None:
    """Require that each field of the feedback agrees with the robot's pose and steps at that moment."""
    echoed = {each["frame"] for each in messages} - {"odom"}
    expect(
        not echoed,
        seen="current_pose is the goal's pose, in base_link"
        if "base_link" in echoed
        else "current_pose is empty",
        expected="the robot's pose in frame odom",
        next="set current_pose=self.pose, the pose of the last odom message",
    )
    for field, key in (("current_pose", "x"), ("distance_remaining", "left")):
        expect(
            len({each[key] for each in messages}) > 1,
            seen=f"{field} never changes: {messages[0][key]:.2f} m in each of {len(messages)} messages",
            expected="a value that is measured in each round",
            next="read self.distance_left(goal_handle, start) and self.pose again in each round",
        )
    negative = next((each for each in messages if each["left"] < 0.0), None)
    expect(
        negative is None,
        seen=f"distance_remaining {negative['left']:.2f} m" if negative else "",
        expected="a distance that is never below 0",
        next="use abs(self.distance_left(goal_handle, start)): it is negative past the goal",
    )
    for each in messages:
        past = each["robot_x"] - GOAL
        expect(
            each["left"] > 0.0 or past <= MAX_FEEDBACK_ERROR,
            seen=f"distance_remaining 0.00 m, with the robot {past:.2f} m past the goal",
            expected=f"{past:.2f} m",
            next="use abs(self.distance_left(goal_handle, start)), the distance on either side of the goal",
        )
        expect(
            abs(each["x"] - each["robot_x"]) <= MAX_FEEDBACK_ERROR
            and abs(each["left"] - abs(GOAL - each["robot_x"])) <= MAX_FEEDBACK_ERROR,
            seen=f"while the robot was at {each['robot_x']:.2f} m, current_pose was at {each['x']:.2f} m and "
            f"distance_remaining was {each['left']:.2f} m",
            expected=f"{each['robot_x']:.2f} m and {abs(GOAL - each['robot_x']):.2f} m",
            next="read self.pose and abs(self.distance_left(goal_handle, start)) after go_on",
        )
    expect(
        messages[-1]["steps"] == steps,
        seen=f"steps_taken {messages[-1]['steps']} at the end",
        expected=f"{steps}, counted from the start of this goal",
        next="set feedback.steps_taken = self.state.steps - start.steps",
    )
    expect(
        all(each["seconds"] > 0.0 for each in messages if each["left"] > TOLERANCE),
        seen=f"estimated_time_remaining 0 s, with {messages[0]['left']:.2f} m left",
        expected="the time that the robot needs for this distance at SPEED",
        next="set estimated_time_remaining to Duration(seconds=left / SPEED).to_msg()",
    )


def reads_the_status_first() -> str:
    """Run the client with a server whose first goal succeeds and whose other goals end in each other status."""
    run_node(SERVER_PROGRAM, "SUCCEEDED", *FAILURES)
    sound, *failed = (run_program("follow.py", "1.0") for _ in ("SUCCEEDED", *FAILURES))
    for how, program in (("SUCCEEDED", sound), *zip(FAILURES, failed, strict=True)):
        expect(
            "Traceback" not in program.stderr,
            seen=f"{how}: {last_error_or_line(program.stderr, 'follow.py')}",
            expected="no traceback",
            next="fix the error that is named here",
        )
    for how, program in zip(FAILURES, failed, strict=True):
        expect(
            program.exit_status != 0,
            seen=f"the goal ended {how}, but the client ended with exit status {program.exit_status}",
            expected="exit status 3",
            next="return 3 unless response.status is GoalStatus.STATUS_SUCCEEDED: after CANCELED and UNKNOWN the robot "
            "has not arrived, either",
        )
    expect(
        sound.exit_status == 0,
        seen=f"the goal ended SUCCEEDED, but the client ended with exit status {sound.exit_status}",
        expected="exit status 0",
        next="return 0 if response.status is GoalStatus.STATUS_SUCCEEDED",
    )
    for how, program in zip(FAILURES, failed, strict=True):
        expect(
            program.exit_status == 3,
            seen=f"the goal ended {how}, but the client ended with exit status {program.exit_status}",
            expected="exit status 3",
            next="return 3",
        )
        expect(
            REASON in program.stderr or how == "UNKNOWN",
            seen=f"the goal ended {how}, and stderr has {program.stderr.strip()!r}",
            expected=f"a line on stderr with the server's error_msg, here {REASON!r}",
            next="call print(…, response.result.error_msg, file=sys.stderr)",
        )
        expect(
            str(STEPS) not in program.stdout,
            seen=f"the goal ended {how}, but the client printed the steps on stdout as after an arrival",
            expected="no steps on stdout",
            next="check the status before you print",
        )
    expect(
        str(STEPS) in sound.stdout,
        seen=f"the goal ended SUCCEEDED, and the last line on stdout is "
        f"{(sound.stdout.strip().splitlines() or [''])[-1]!r}",
        expected=f"a line with the result's total_steps, here {STEPS}",
        next="print response.result.total_steps",
    )
    return f"after SUCCEEDED: exit status 0 and the steps; after {', '.join(FAILURES)}: exit status 3"


def _trial(name: str) -> list[dict[str, Any]]:
    """Run a trial of the student's callbacks in a separate process; return the JSON values that it printed.

    Raises GapError when the process printed none.
    """
    program = run_program(TRIALS_PROGRAM, name, timeout=TRIAL_TIMEOUT)
    seen = [json.loads(line) for line in program.stdout.splitlines() if line.startswith("{")]
    if not seen and program.stopped:
        raise not_yet(
            f"the callback had not returned after {TRIAL_TIMEOUT:.0f} s",
            "a callback that returns",
            "find the loop that does not end",
        )
    if not seen:
        reason = (program.stderr.strip().splitlines() or ["it printed nothing"])[-1]
        raise not_yet(
            f"the program ended: {reason}", "a callback that returns", "fix the error that is named here"
        )
    return seen


GAPS = (
    Gap("rejecting_walk.py", rejects_what_cannot_work),
    Gap("settled_walk.py", measures_after_the_robot_stands, duration=8),
    Gap("told_walk.py", publishes_feedback, duration=8),
    Gap("follow.py", reads_the_status_first),
)
