"""Judges a client of `walk_to`: the goal it sent, the feedback it printed, and how it ended."""

from __future__ import annotations

import math
import re

from action_msgs.msg import GoalStatus

from autograder.authoring import events as ev
from autograder.authoring.action_client_checks import (
    has_number,
    require_exit,
    require_goal_answered,
    require_goal_finished,
    require_no_cancel,
    require_no_flood,
    require_numbers,
    require_one_goal,
)
from autograder.authoring.failure import expect
from autograder.authoring.fields import expect_field
from autograder.authoring.missing import unseen
from autograder.authoring.scripted_goal import ScriptedGoal
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


def require_goal_at(run: Transcript, x: float, y: float, yaw: float) -> ScriptedGoal:
    """Require one goal at a pose (m, m, rad) in odom."""
    goal = require_one_goal(run, WALK)
    because = f"the program was started with {' '.join(run.params['arguments'])}"
    for path, value in (("target_pose.pose.position.x", x), ("target_pose.pose.position.y", y)):
        _expect(goal, path, value, because=because, help=f"Set goal.{path} from the arguments, in metres.")
    _expect(
        goal,
        "target_pose.header.frame_id",
        "odom",
        because="a pose means nothing without its frame",
        help='Set goal.target_pose.header.frame_id = "odom".',
    )
    rotation = goal.message.target_pose.pose.orientation
    heading = 2 * math.atan2(rotation.z, rotation.w)
    length = math.hypot(rotation.x, rotation.y, rotation.z, rotation.w)
    expect(
        abs(math.remainder(heading - yaw, math.tau)) < 0.01 and abs(length - 1.0) < 0.01,
        expected=f"a quaternion that turns by {yaw:g} rad about z",
        observed=f"x {rotation.x:.3f}, y {rotation.y:.3f}, z {rotation.z:.3f}, w {rotation.w:.3f}",
        help="orientation.z = math.sin(yaw / 2) and orientation.w = math.cos(yaw / 2); without a yaw, w is 1.0.",
        at=goal.received.t,
    )
    return goal


def require_success(run: Transcript, goal: ScriptedGoal, within: float, *, canceled: bool = False) -> None:
    """Require exit status 0 and one line on stdout with SUCCEEDED and the final pose, and, unless it was, no cancel."""
    require_goal_answered(run, goal, accepted=True)
    finished = require_goal_finished(run, goal, GoalStatus.STATUS_SUCCEEDED)
    exited = require_exit(
        run, within, SUCCEEDED, because="the goal SUCCEEDED", stream="stdout", help=STATUS_HELP
    )
    if not canceled:
        require_no_cancel(goal, because="the robot arrives")
    pose = finished.result.final_pose.pose
    line = require_ending_line(run, "SUCCEEDED", exited.t)
    for name, value in (("x", pose.position.x), ("y", pose.position.y)):
        expect(
            has_number(line, value),
            expected=f"the final {name}, {value:.2f} m, in the line that says how it ended",
            observed=f"“{line}”",
            help="Print response.result.final_pose.pose.position, not what you asked for: the robot says where it is.",
            at=exited.t,
        )


def require_success_after_early_feedback(run: Transcript, within: float) -> None:
    """Require that feedback from before the acceptance disturbed nothing."""
    goal = require_one_goal(run, WALK)
    if not goal.feedback or goal.reply is None or goal.feedback[0].t > goal.reply.t:
        raise unseen(run, "no feedback came before the acceptance")
    require_success(run, goal, within)


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


def require_feedback_lines(run: Transcript, goal: ScriptedGoal) -> None:
    """Require a line on stdout for each feedback message that came before the result."""
    if goal.finished is None:
        raise unseen(run, "the goal did not end")
    sent = [event for event in goal.feedback if event.t < goal.finished.t - 0.3]
    if len(sent) < 3:
        raise unseen(run, f"only {len(sent)} feedback messages were sent")
    require_no_flood(run, 3 * len(goal.feedback) + 20, sent[0].t)
    require_numbers(
        run.output("stdout").splitlines(),
        [event.feedback.distance_remaining for event in sent],
        what="a line for each feedback with distance_remaining",
        help="Give send_goal_async a feedback_callback; the action's message is in message.feedback, so print "
        "message.feedback.distance_remaining.",
        at=sent[0].t,
    )


def require_failure(run: Transcript, within: float, status: int, *, because: str, help: str) -> None:
    """Require an exit status other than 0, in time, with a line on stderr."""
    require_exit(run, within, status, because=because, stream="stderr", help=help)


def require_usage(run: Transcript, within: float) -> None:
    """Require that wrong arguments ended the program with the usage, before there was a node."""
    exited = require_exit(
        run,
        within,
        USAGE,
        because=f"it was started with {' '.join(run.params['arguments'])}",
        stream="stderr",
        help="Let argparse read rclpy.utilities.remove_ros_args(sys.argv)[1:] with type=float: it ends the program "
        "with status 2 itself.",
    )
    expect(
        "usage" in run.output("stderr").lower(),
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


def require_rejection(run: Transcript, within: float) -> None:
    """Require that the program told that its goal was rejected."""
    require_goal_answered(run, require_one_goal(run, WALK), accepted=False)
    require_failure(
        run,
        within,
        REJECTED,
        because="the goal was rejected",
        help="Look at goal_handle.accepted before you ask for the result: a rejected goal has none.",
    )


def require_abort(run: Transcript, within: float) -> None:
    """Require that the program told that its goal was aborted, with the server's reason if there is one."""
    finished = require_goal_finished(run, require_one_goal(run, WALK), GoalStatus.STATUS_ABORTED)
    require_failure(run, within, ABORTED, because="the goal was ABORTED", help=STATUS_HELP)
    require_reason(run, finished)


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


def _expect(goal: ScriptedGoal, path: str, value: object, *, because: str, help: str) -> None:
    expect_field(goal.message, path, value, because=because, help=help, at=goal.received.t)
