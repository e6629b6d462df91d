"""Chapter 6: walk to a pose."""

from __future__ import annotations

import json
from typing import Any

from chapters.support import harness
from chapters.support.harness.goal_server import REASON, STEPS
from lab.learning.gap import Gap, expect, not_yet
from lab.learning.gap_checks import last_words
from lab.running.programs import run_program
from lab.running.student_nodes import run_node

CALLBACKS = f"{harness.__path__[0]}/walk_callbacks.py"
SERVER = f"{harness.__path__[0]}/goal_server.py"
MOST = 40.0  # s for a trial; sound lines need up to 6 s
TOLERANCE = 0.10  # m, as the chapter's file has it
GOAL = 0.5  # m ahead, in the trial
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
    answers = _trial("goals")
    for answer in answers:
        case, said = answer["case"], answer["said"]
        wanted = "ACCEPT" if case in TO_ACCEPT else "REJECT"
        if said == "None":
            raise not_yet(
                f"{case}: the callback returned nothing",
                f"GoalResponse.{wanted}",
                "end every path with a return",
            )
        expect(
            said in ("ACCEPT", "REJECT") or "Error" in said,
            seen=f"{case}: the callback returned {said}",
            expected=f"GoalResponse.{wanted}",
            next="return GoalResponse.ACCEPT or GoalResponse.REJECT; rclpy takes anything else for a rejection",
        )
        expect(
            said == wanted,
            seen=f"{case}: {said}",
            expected=f"GoalResponse.{wanted}",
            next="mend what this error names" if "Error" in said and "NoneType" not in said else ADVICE[case],
        )
    return f"{len(TO_ACCEPT)} goals are accepted, {len(answers) - len(TO_ACCEPT)} rejected"


def measures_after_settling() -> str:
    """Walk a toy robot half a metre; somebody pushes it back when it stops."""
    (seen,) = _trial("settles")
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
        else "mend what this error names",
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


def reads_the_status_first() -> str:
    """Run the client beside a server whose goals succeed, and end in each other way."""
    run_node(SERVER, "SUCCEEDED", *FAILURES)
    sound, *failed = (run_program("follow.py", "1.0") for _ in ("SUCCEEDED", *FAILURES))
    for how, program in (("SUCCEEDED", sound), *zip(FAILURES, failed, strict=True)):
        expect(
            "Traceback" not in program.stderr,
            seen=f"{how}: {last_words(program.stderr, 'follow.py')}",
            expected="a client without a traceback",
            next="mend what this error names",
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
    program = run_program(CALLBACKS, name, timeout=MOST)
    seen = [json.loads(line) for line in program.stdout.splitlines() if line.startswith("{")]
    if not seen and program.stopped:
        raise not_yet(
            f"the callback had not returned after {MOST:.0f} s",
            "a callback that returns",
            "look for a loop that does not end",
        )
    if not seen:
        reason = (program.stderr.strip().splitlines() or ["it printed nothing"])[-1]
        raise not_yet(f"the program ended: {reason}", "a callback that returns", "mend what this error names")
    return seen


GAPS = (
    Gap("rejecting_walk.py", rejects_what_cannot_work),
    Gap("settled_walk.py", measures_after_settling),
    Gap("follow.py", reads_the_status_first),
)
