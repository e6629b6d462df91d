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
TRIAL_TIMEOUT = 40.0  # s for a trial; correct lines need up to 6 s
TOLERANCE = 0.10  # m, as the chapter's file has it
GOAL = 0.5  # m ahead, in the trial
PERIOD, MIN_PERIOD, MAX_PERIOD = 0.2, 0.1, 0.35  # s between feedback messages: asked for, and accepted
MAX_FEEDBACK_ERROR = (
    0.07  # m by which feedback may differ from the robot: a command moves the toy robot 0.06 m
)
FAILURES = ("ABORTED", "CANCELED", "UNKNOWN")
TO_ACCEPT = ("1 m in base_link, while the robot stands", "3 m in base_link, while the robot stands")
ADVICE = {
    "1 m in base_link, while the robot stands": "end with `return GoalResponse.ACCEPT` for a sound goal",
    "3 m in base_link, while the robot stands": "FARTHEST itself is still allowed: use <=",
    "a goal before the first odom": "reject while self.pose is None, before you use anything else",
    "a goal before the first robot_state": "reject while self.state is None, before you read its mode",
    "a goal while the robot walks": "accept only when self.state.mode == RobotState.STANDING",
    "a goal while the robot lies on the floor": "accept only when self.state.mode == RobotState.STANDING",
    "a goal while the motors are off": "accept only when self.state.mode == RobotState.STANDING",
    "1 m in frame odom": 'compare goal.target_pose.header.frame_id with "base_link"',
    "1 m without a frame": 'an empty frame is not "base_link": reject everything else',
    "-1 m": "position.x has to be above 0",
    "0 m": "position.x has to be above 0: use <, not <=",
    "3.5 m": "position.x has to be at most FARTHEST",
    "NaN m": "ask whether 0.0 < x <= FARTHEST: with NaN that is false; or ask math.isfinite(x)",
}


def rejects_what_cannot_work() -> str:
    """Ask the goal callback about thirteen goals."""
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
            next="return GoalResponse.ACCEPT or GoalResponse.REJECT; rclpy takes anything else for a rejection",
        )
        expect(
            returned == wanted,
            seen=f"{case}: {returned}",
            expected=f"GoalResponse.{wanted}",
            next="fix the error that is named here"
            if "Error" in returned and "NoneType" not in returned
            else ADVICE[case],
        )
    return f"{len(TO_ACCEPT)} goals are accepted, {len(trials) - len(TO_ACCEPT)} rejected"


def measures_after_settling() -> str:
    """Walk a toy robot half a metre; somebody pushes it back when it stops."""
    (seen,) = _trial("settling")
    returned, ended = seen["returned"], seen["ended"]
    if "had not ended" in returned:
        raise not_yet(
            "the loop goes round and round and never ends the goal",
            "SUCCEEDED as soon as it stands within TOLERANCE",
            "compare the absolute value: abs(self.distance_left(goal_handle, start)) <= TOLERANCE",
        )
    expect(
        "Error" not in returned,
        seen=f"execute raised {returned}",
        expected="the result",
        next="return the result right after the terminal call"
        if "after succeed" in returned
        else "fix the error that is named here",
    )
    expect(
        ended,
        seen="execute returned without a terminal call",
        expected="a success",
        next="call goal_handle.succeed() before you return the result",
    )
    expect(
        ended[0] == "succeed",
        seen="the goal was aborted",
        expected="another approach, and then a success",
        next="if the robot is not within TOLERANCE, do nothing: the loop goes round",
    )
    expect(
        ended[1] == "standing",
        seen="SUCCEEDED while the robot was in mid-step",
        expected="a robot that stands",
        next="call self.stand_still() first",
    )
    expect(
        abs(seen["final"] - GOAL) <= TOLERANCE,
        seen=f"SUCCEEDED where the robot stands, {abs(seen['final'] - GOAL):.2f} m from the goal",
        expected=f"another approach, because that is more than {TOLERANCE:.2f} m",
        next="measure after stand_still(), and succeed only if that is within TOLERANCE",
    )
    expect(
        returned.startswith("a result"),
        seen=f"SUCCEEDED, and execute returned {returned}",
        expected="the result",
        next="end with `return result`",
    )
    expect(
        returned == f"a result with final_pose {seen['final']:.2f}",
        seen=f"{returned}, and the robot stands at {seen['final']:.2f}",
        expected="the pose in which it stands",
        next="call self.result(start) after stand_still()",
    )
    expect(
        not seen["filled_late"],
        seen="succeed(), and then self.result(start)",
        expected="the result first",
        next="call self.result(start) before goal_handle.succeed(): if filling the result raises, the client must not "
        "read SUCCEEDED",
    )
    return "pushed back when it stopped, the robot walked again; SUCCEEDED came when it stood at the goal"


def publishes_feedback() -> str:
    """Receive the feedback while a toy robot walks half a metre, is pushed back, and walks again."""
    (seen,) = _trial("feedback")
    returned, messages = seen["returned"], seen["feedback"]
    expect(
        "Error" not in returned,
        seen=f"execute raised {returned}",
        expected="the result",
        next="fix the error that is named here",
    )
    expect(
        len(messages) > 1,
        seen=f"{'one' if messages else 'no'} feedback message in the whole walk",
        expected=f"one every {PERIOD} s",
        next="call goal_handle.publish_feedback(feedback) in each round, not only in the last",
    )
    _require_five_a_second([each["t"] for each in messages])
    _require_measured(messages, seen["steps"])
    last = messages[-1]
    expect(
        last["robot_stands"] and abs(last["robot_x"] - GOAL) <= TOLERANCE,
        seen=f"the last feedback came {abs(last['robot_x'] - GOAL):.2f} m from the goal, before the robot stood",
        expected="one more when it stands at the goal, before succeed()",
        next="publish in the last round, too: don't ask for `arrived`",
    )
    expect(
        returned.startswith("a result") and seen["ended"][:1] == ["succeed"],
        seen=f"execute returned {returned} after {' '.join(seen['ended'][:1]) or 'no terminal call'}",
        expected="the result after succeed()",
        next="don't leave the loop: the lines below it end the goal",
    )
    return f"{len(messages)} feedback messages, five a second; the last came from where the robot stands"


def _require_five_a_second(times: list[float]) -> None:
    """Require about PERIOD between most messages; when the robot stops, one may come later."""
    usual = median(after - before for before, after in pairwise(times))
    expect(
        usual <= MAX_PERIOD,
        seen=f"a message every {usual:.1f} s: {1 / usual:.1g} Hz",
        expected=f"one every {PERIOD} s",
        next="wait for PERIOD in each round, and only there",
    )
    expect(
        usual >= MIN_PERIOD,
        seen=f"messages {1000 * usual:.0f} ms after one another",
        expected=f"one every {PERIOD} s",
        next="wait after each: time.sleep(PERIOD); a client keeps the last ten only",
    )


def _require_measured(messages: list[dict[str, Any]], steps: int) -> None:
    """Require that each field says what the robot was at, by the last odom and robot_state."""
    echoed = {each["frame"] for each in messages} - {"odom"}
    expect(
        not echoed,
        seen="current_pose is the goal's pose, in base_link"
        if "base_link" in echoed
        else "current_pose is empty",
        expected="where the robot is, in odom",
        next="current_pose=self.pose: the last odom",
    )
    for field, key in (("current_pose", "x"), ("distance_remaining", "left")):
        expect(
            len({each[key] for each in messages}) > 1,
            seen=f"{field} never changes: {messages[0][key]:.2f} m in each of {len(messages)} messages",
            expected="what is measured in that round",
            next="self.distance_left(goal_handle, start) and self.pose, anew in each round",
        )
    negative = next((each for each in messages if each["left"] < 0.0), None)
    expect(
        negative is None,
        seen=f"distance_remaining {negative['left']:.2f} m" if negative else "",
        expected="a distance, never below 0",
        next="abs(self.distance_left(goal_handle, start)): it is negative past the goal",
    )
    for each in messages:
        expect(
            abs(each["x"] - each["robot_x"]) <= MAX_FEEDBACK_ERROR
            and abs(each["left"] - abs(GOAL - each["robot_x"])) <= MAX_FEEDBACK_ERROR,
            seen=f"at {each['robot_x']:.2f} m, current_pose says {each['x']:.2f} m and distance_remaining "
            f"{each['left']:.2f} m",
            expected=f"{each['robot_x']:.2f} m, and {abs(GOAL - each['robot_x']):.2f} m left",
            next="self.pose and abs(self.distance_left(goal_handle, start)), after go_on",
        )
    expect(
        messages[-1]["steps"] == steps,
        seen=f"steps_taken {messages[-1]['steps']} at the end",
        expected=f"{steps}, counted from the start of this goal",
        next="feedback.steps_taken = self.state.steps - start.steps",
    )
    expect(
        all(each["seconds"] > 0.0 for each in messages if each["left"] > TOLERANCE),
        seen=f"estimated_time_remaining 0 s, with {messages[0]['left']:.2f} m left",
        expected="the time for that distance at SPEED",
        next="Duration(seconds=left / SPEED).to_msg()",
    )


def reads_the_status_first() -> str:
    """Run the client beside a server whose goals succeed, and end in each other way."""
    run_node(SERVER_PROGRAM, "SUCCEEDED", *FAILURES)
    sound, *failed = (run_program("follow.py", "1.0") for _ in ("SUCCEEDED", *FAILURES))
    for how, program in (("SUCCEEDED", sound), *zip(FAILURES, failed, strict=True)):
        expect(
            "Traceback" not in program.stderr,
            seen=f"{how}: {last_error_or_line(program.stderr, 'follow.py')}",
            expected="a client without a traceback",
            next="fix the error that is named here",
        )
    for how, program in zip(FAILURES, failed, strict=True):
        expect(
            program.exit_status != 0,
            seen=f"{how}, and the client ended with exit status {program.exit_status}",
            expected="exit status 3",
            next="return 3 unless response.status is GoalStatus.STATUS_SUCCEEDED: CANCELED and UNKNOWN are no "
            "arrival, either",
        )
    expect(
        sound.exit_status == 0,
        seen=f"SUCCEEDED, and the client ended with exit status {sound.exit_status}",
        expected="exit status 0",
        next="the status is in response.status, and GoalStatus.STATUS_SUCCEEDED is success",
    )
    for how, program in zip(FAILURES, failed, strict=True):
        expect(
            program.exit_status == 3,
            seen=f"{how}, and the client ended with exit status {program.exit_status}",
            expected="exit status 3",
            next="return 3",
        )
        expect(
            REASON in program.stderr or how == "UNKNOWN",
            seen=f"{how}, and stderr says {program.stderr.strip()!r}",
            expected=f"a line on stderr with the server's error_msg, here {REASON!r}",
            next="print(…, response.result.error_msg, file=sys.stderr)",
        )
        expect(
            str(STEPS) not in program.stdout,
            seen=f"{how}, and stdout has the steps as if the robot had arrived",
            expected="nothing on stdout about an arrival",
            next="look at the status before you print",
        )
    expect(
        str(STEPS) in sound.stdout,
        seen=f"SUCCEEDED, and the last line on stdout is {(sound.stdout.strip().splitlines() or [''])[-1]!r}",
        expected=f"a line with the result's total_steps, here {STEPS}",
        next="print response.result.total_steps",
    )
    return f"SUCCEEDED: exit status 0 and the steps; {', '.join(FAILURES)}: exit status 3"


def _trial(name: str) -> list[dict[str, Any]]:
    """Run a trial of the student's callbacks; return what it saw.

    Raises GapError when the program ended before that.
    """
    program = run_program(TRIALS_PROGRAM, name, timeout=TRIAL_TIMEOUT)
    seen = [json.loads(line) for line in program.stdout.splitlines() if line.startswith("{")]
    if not seen and program.stopped:
        raise not_yet(
            f"the callback had not returned after {TRIAL_TIMEOUT:.0f} s",
            "a callback that returns",
            "look for a loop that does not end",
        )
    if not seen:
        reason = (program.stderr.strip().splitlines() or ["it printed nothing"])[-1]
        raise not_yet(
            f"the program ended: {reason}", "a callback that returns", "fix the error that is named here"
        )
    return seen


GAPS = (
    Gap("rejecting_walk.py", rejects_what_cannot_work),
    Gap("settled_walk.py", measures_after_settling),
    Gap("told_walk.py", publishes_feedback),
    Gap("follow.py", reads_the_status_first),
)
