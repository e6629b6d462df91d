"""How a client that walks the robot ends: its exit statuses, and the line that says it."""

from __future__ import annotations

import re

from autograder.authoring import events as ev
from autograder.authoring.action_client_checks import why_not_this_status
from autograder.authoring.client_checks import require_end
from autograder.authoring.failure import expect
from autograder.authoring.transcript import Transcript

WALK = "walk_to"
SUCCEEDED, NO_SERVER, REJECTED, ABORTED, CANCELED = range(5)  # exit statuses
PATIENCE = 5.0  # s
FINDING = 2.0  # s from the node's appearance until the grader has seen it
USAGE = 2  # the exit status of argparse
STATUS_HELP = (
    "Look at response.status first: 4 is SUCCEEDED, 5 CANCELED, 6 ABORTED (action_msgs/GoalStatus). "
    "Return the exit status from main() and end the file with sys.exit(main())."
)
_PARSE = (
    "Let argparse read rclpy.utilities.remove_ros_args(sys.argv)[1:] with type=float: it ends the program with status "
    "2 itself."
)


def require_ending_line(run: Transcript, word: str, at: float, since: float = 0.0) -> str:
    """Require exactly one line on stdout from a time (s) on that holds this status, and return it."""
    said = [event.text for event in run.all(ev.NodeOutput) if event.stream == "stdout" and event.t >= since]
    lines = [line for line in said if re.search(rf"\b{word}\b", line, re.IGNORECASE)]
    expect(
        len(lines) == 1,
        expected=f"one line on stdout with the word {word}",
        observed=f"{len(lines)}" + (": " + " | ".join(lines[:3]) if lines else ""),
        help=f"print({word!r}, …) once, when the result has come.",
        at=at,
    )
    return lines[0]


def require_usage(run: Transcript, within: float) -> None:
    """Require that wrong arguments ended the program with the usage, before there was a node."""
    exited = require_end(run, within)
    arguments = " ".join(run.params["arguments"])
    observed, help = why_not_this_status(run, exited, _PARSE)
    expect(
        exited.returncode == USAGE,
        expected=f"exit status {USAGE}: it was started with {arguments}",
        observed=observed,
        help=help,
        at=exited.t,
    )
    said = run.output("stderr")
    expect(
        "usage" in said.lower() and "Traceback (most recent call last)" not in said,
        expected="the usage on stderr",
        observed=f"“{run.last_words}”",
        help="argparse prints it: use parser.parse_args() or parser.error().",
        at=exited.t,
    )
    expect(
        run.first(ev.NodeReady) is None,
        expected="no node: there is nothing to do",
        observed="a node was started",
        help="Read the arguments before rclpy.init().",
        at=exited.t,
    )


def require_reason(run: Transcript, finished: ev.GoalFinished) -> None:
    """Require exactly one line with the server's reason, on stderr."""
    reason = finished.result.error_msg
    expect(
        reason in run.output("stderr"),
        expected=f"the server's reason on stderr: {reason}",
        observed=f"“{run.last_words}”",
        help="Print response.result.error_msg with file=sys.stderr.",
        at=finished.t,
    )
    lines = [line for line in run.output().splitlines() if reason in line]
    expect(
        len(lines) == 1,
        expected="one line, on stderr, with the server's reason",
        observed=f"{len(lines)}: " + " | ".join(lines[:3]),
        help="Say once how it ended: print error_msg in one place, or log it, not both.",
        at=finished.t,
    )
