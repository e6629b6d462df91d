"""Requirements on every run of a client of a walking action, whatever its server and the user do.

An exercise's model makes obligations of the functions that take a `ClientRun`:

sends_one_goal = obligation(1, 12, of=clients)(client_obligations.sends_one_goal)
"""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Callable
from itertools import pairwise
from typing import TypeVar

from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.fields import expect_field
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.failure import Failure, expect
from autograder.authoring.obligation import Obligation, obligation, whole_run
from autograder.authoring.requirements.client_checks import (
    NUMBER,
    has_number,
    how_to_give_up,
    require_end,
    why_not_this_status,
)
from autograder.authoring.walking.client_ends import TRACEBACK, printed, require_ending, require_its_line
from autograder.authoring.walking.client_run import SILENCE_LIMIT, Cause, ClientRun, clients

L = TypeVar("L", bound=ClientRun)
PRINT_TIMEOUT = 0.5  # s from a feedback message to its line
PRINT_SLACK = 0.5  # s on the arena's clock: 0.1 s of real time at scale 5, on a busy machine
DELIVERY_SLACK = 0.3  # s by which the result may overtake feedback
END_TIMEOUT = 10.0  # s
USAGE_STATUS = 2  # the exit status of argparse
REFUSED = re.compile(
    r"refus|reject|declin|den(?:y|ied)|(?:not|n't|cannot) (?:be )?cancel|fail|terminated|already|too late",
    re.IGNORECASE,
)
ROTATION_TOLERANCE = (
    0.0005  # rad, and of a quaternion's length, by which a goal may differ from the arguments
)
ON_CTRL_C = (
    "rclpy shuts down at Ctrl-C, and then nothing can be sent: call rclpy.init(signal_handler_options="
    "SignalHandlerOptions.NO), handle the signal yourself, and call cancel_goal_async()."
)


# -- what a client sends ----------------------------------------------------------------------------------------------


def sends_one_goal(client: ClientRun) -> str | None:
    """It sends one goal, at x, y and yaw of its arguments, in frame odom."""
    goal, field, arguments = client.goal, client.pose_field, client.run.params["arguments"]
    if goal is None:
        client.ends()  # raises if the goal had to be sent
        return None
    x, y, yaw = (*map(float, arguments), 0.0)[:3]
    because = f"the program was started with {' '.join(arguments)}"
    message, at = goal.message, goal.received.t
    for path, value in ((f"{field}.pose.position.x", x), (f"{field}.pose.position.y", y)):
        help = f"Set goal.{path} from the arguments, in metres."
        expect_field(message, path, value, because=because, help=help, at=at)
    frame = f"{field}.header.frame_id"
    because, help = "a pose means nothing without its frame", f'Set goal.{frame} = "odom".'
    expect_field(message, frame, "odom", because=because, help=help, at=at)
    rotation = getattr(message, field).pose.orientation
    heading = 2 * math.atan2(rotation.z, rotation.w)
    length = math.hypot(rotation.x, rotation.y, rotation.z, rotation.w)
    expect(
        abs(math.remainder(heading - yaw, math.tau)) < ROTATION_TOLERANCE
        and abs(length - 1.0) < ROTATION_TOLERANCE,
        expected=f"a quaternion that turns by {yaw:g} rad about z",
        observed=f"x {rotation.x:.3f}, y {rotation.y:.3f}, z {rotation.z:.3f}, w {rotation.w:.3f}",
        help="orientation.z = math.sin(yaw / 2) and orientation.w = math.cos(yaw / 2); without a yaw, w is 1.0.",
        at=at,
    )
    return "without YAW" if len(arguments) == 2 else "YAW < 0" if yaw < 0 else "YAW ≥ 0"


def require_cancels_in_time(
    client: L, needless: Callable[[L, float], Failure], how_to_cancel: Callable[[L, Cause], str]
) -> list[Cause]:
    """Require a cancel request for each cause that requires one, and none without a cause; return the causes.

    `needless` returns the failure for a request at a time (s) without a cause; `how_to_cancel` returns what to do about
    a request that is missing.
    """
    assert client.goal is not None
    causes = client.causes()
    asked = [cancel.received.t for cancel in client.goal.cancels]
    for number, cancel in enumerate(client.goal.cancels, start=1):
        t = cancel.received.t
        due = [cause for cause in causes if cause.since <= t]
        if not due:
            raise needless(client, t)
        expect(
            cancel.received.goal == client.goal.name,
            expected="a request to cancel this goal",
            observed="one without an id, which cancels the goals of all clients",
            help="Call cancel_goal_async() of this goal's handle.",
            at=t,
        )
        expect(
            number <= len({cause.name for cause in due}) or not all(cause.once for cause in due),
            expected="one request to cancel the goal",
            observed=f"{number}, the last {t - asked[0]:.1f} s after the first",
            help="Remember that you have sent a request: the server is already working on the first one.",
            at=t,
        )
    for cause in causes:
        if cause.is_required and not any(t <= cause.latest for t in asked):
            raise Failure(
                expected=f"a request to cancel the goal, because {cause.because}",
                observed=f"the first {asked[0] - cause.since:.1f} s after it"
                if asked
                else "none: the robot walks on, and no client watches it",
                help=how_to_cancel(client, cause),
                at=asked[0] if asked else client.run.end,
            )
    return causes


def _needless(client: ClientRun, t: float) -> Failure:
    """Return the failure for a cancel request that came without a cause."""
    assert client.goal is not None
    last_message = max([client.goal.received.t, *(each for each in client.received if each <= t)])
    typed = [event.line for event in client.run.all(ev.NodeTyped) if event.t <= t]
    after = ""
    if typed:
        after = ", after the end of the input" if typed[-1] is None else f", after the line “{typed[-1]}”"
    return Failure(
        expected=f"no request to cancel before a line q, Ctrl-C or {SILENCE_LIMIT:g} s of silence",
        observed=f"one came {t - last_message:.1f} s after the last message of the server{after}",
        help="Cancel only when a line, without its newline, is exactly q, at Ctrl-C, or after 5 s of silence: a goal "
        f"may take long, and the last message came at {last_message:.1f} s.",
        at=t,
    )


def _how_to_cancel(client: ClientRun, cause: Cause) -> str:
    if cause.name == "Ctrl-C":
        return ON_CTRL_C
    if cause.name == "silence":
        return how_to_give_up(client.run)
    if client.asked[0] < client.accepted:
        return "There is no goal handle to cancel with yet: remember the q, and check it right after the acceptance."
    return (
        "Read stdin in a thread that sets an event; where you wait for the result, check the event and call "
        "goal_handle.cancel_goal_async()."
    )


def asks_for_its_result(client: ClientRun) -> str | None:
    """It requests the result before the server, which keeps it only for a while, discards it."""
    kept_for = (client.run.params.get("server") or {}).get("kept_for")
    if kept_for is None or client.goal is None or client.goal.finished is None:
        return None
    asked, forgotten = client.goal.result_requested, client.goal.finished.t + kept_for
    expect(
        asked is not None and asked.t < forgotten,
        expected=f"a request for the result before the server discards it, at {forgotten:.1f} s",
        observed=f"the first at {asked.t:.1f} s" if asked else "none",
        help="Call get_result_async() right after the acceptance; its future is done when the goal ends.",
        at=forgotten,
    )
    return f"kept for {kept_for:g} s"


# -- how a client follows its goal ------------------------------------------------------------------------------------


def follows_its_goal(client: ClientRun) -> str:
    """It cancels its goal when it must, and ends in time, with the exit status and the line for the goal's end."""
    causes = require_cancels_in_time(client, _needless, _how_to_cancel) if client.goal else []
    allowed, exited = require_ending(client)
    require_its_line(client, allowed, exited)
    ended, canceled = allowed[0].name, " and ".join(cause.name for cause in causes)
    return ended if canceled in ("", ended) else f"{ended}, {canceled}"


def follows(*clauses: int) -> Obligation:
    """Return the obligation `follows_its_goal`, for these clauses."""
    return obligation(*clauses, of=clients)(follows_its_goal)


# -- what a client prints on the way ----------------------------------------------------------------------------------


def prints_each_feedback(client: ClientRun, within: float = math.inf) -> str | None:
    """For each feedback it prints one line on stdout with distance_remaining, and no such line for anything else."""
    if client.goal is None:
        return None
    finished = client.goal.finished.t if client.goal.finished else math.inf
    due = min([finished, *(end.earliest for end in client.ends())])  # from when on the program may end
    over = min(client.exited, due - DELIVERY_SLACK)
    sent = [each for each in client.goal.feedback if client.accepted <= each.t < over]
    lines = printed(client.run, "stdout")
    rest = iter(lines)
    forms: Counter[str] = Counter()
    for each in sent:
        distance = each.feedback.distance_remaining
        line = next(
            (line for line in rest if line.t > each.t - 0.1 and has_number(line.text, distance)), None
        )
        if line is None:
            raise Failure(
                expected=f"a line for each feedback with distance_remaining: a line with {distance:.2f}",
                observed=" | ".join(line.text for line in lines[:6]) or "nothing on stdout",
                help="Give send_goal_async a feedback_callback; the action's message is in message.feedback, so print "
                "message.feedback.distance_remaining.",
                at=each.t,
            )
        forms[_form(line.text)] += 1
        expect(
            line.t - each.t <= within + PRINT_SLACK,
            expected=f"a line with {distance:.2f} at most {within:g} s after the feedback",
            observed=f"it came {line.t - each.t:.1f} s after it",
            help="The thread that spins is blocked, most likely by reading stdin: input() and readline() wait for a "
            "whole line. Read stdin in a thread of its own.",
            at=each.t,
        )
    alike = [line for line in lines if _form(line.text) in forms]
    expect(
        len(alike) <= len(client.goal.feedback),
        expected=f"one line for each feedback, {len(client.goal.feedback)} in all",
        observed=f"{len(alike)}: " + " | ".join(line.text[:80] for line in alike[-3:]),
        help="Print one line for each feedback, in the feedback callback and nowhere else.",
        at=alike[-1].t if alike else None,
    )
    return _how_it_came(client, [each.t for each in sent]) if sent else None


def _form(line: str) -> str:
    """Return a line without its numbers: the lines of a program's feedback have one form."""
    return NUMBER.sub("#", line)


def _how_it_came(client: ClientRun, times: list[float]) -> str:
    gaps = [later - earlier for earlier, later in pairwise(times)]
    came = "up to 4.5 s apart" if any(gap > 1.5 for gap in gaps) else "each 0.2 s"
    if client.interrupted < times[-1]:
        return f"{came}, also after Ctrl-C"
    return f"{came}, also after a q" if client.asked and client.asked[0] < times[-1] else came


def prints_feedback_in_time(client: ClientRun) -> str | None:
    """Each feedback is printed within 0.5 s, whether somebody types or not."""
    return prints_each_feedback(client, PRINT_TIMEOUT)


def says_what_was_refused(client: ClientRun) -> str | None:
    """A line says that a cancel was refused, whatever the return_code: goals_canceling is empty."""
    cancel = client.goal.cancels[0] if client.goal and client.goal.cancels and client.asked else None
    if cancel is None or cancel.reply is None or cancel.reply.canceling:
        return None
    reply = cancel.reply
    if cancel.received.t >= client.interrupted or reply.t >= min(
        client.result - DELIVERY_SLACK, client.exited
    ):
        return None
    said = [
        event.text for event in client.run.all(ev.NodeOutput) if reply.t - 0.05 <= event.t <= client.exited
    ]
    others = [line for line in said if not NUMBER.search(line)]
    expect(
        any(REFUSED.search(line) for line in said),
        expected=f"a line with the word refused, because goals_canceling is empty (return_code {reply.return_code})",
        observed=" | ".join((others or said)[:4]) or "nothing was printed meanwhile",
        help="Check the answer of cancel_goal_async(). return_code 0 does not mean accepted: rclpy's server sends 0 "
        "with a refusal, too. The goal is being cancelled if it is in goals_canceling; every other answer is a "
        "refusal, whatever its return_code.",
        at=reply.t,
    )
    return f"refused with code {reply.return_code}"


# -- command-line arguments, which the client checks before it creates a node -----------------------------------------


def refuses_what_is_no_pose(run: Transcript) -> str:
    """Wrong arguments end it with status 2 and the usage on stderr, before a node is started."""
    exited = require_end(run, END_TIMEOUT)
    arguments = " ".join(run.params["arguments"])
    help = (
        "Let argparse read rclpy.utilities.remove_ros_args(sys.argv)[1:] with type=float: it ends the program with "
        "status 2 itself."
    )
    observed, help = why_not_this_status(run, exited, help)
    expect(
        exited.returncode == USAGE_STATUS,
        expected=f"exit status {USAGE_STATUS}: it was started with {arguments}",
        observed=observed,
        help=help,
        at=exited.t,
    )
    said = run.output("stderr")
    expect(
        "usage" in said.lower() and TRACEBACK not in said,
        expected="the usage on stderr",
        observed=f"“{run.last_words}”",
        help="argparse prints it: use parser.parse_args() or parser.error().",
        at=exited.t,
    )
    expect(
        run.first(ev.NodeReady) is None,
        expected="no node, because the arguments are wrong",
        observed="a node was started",
        help="Read the arguments before rclpy.init().",
        at=exited.t,
    )
    return arguments


# -- all of it --------------------------------------------------------------------------------------------------------


def all_of(*each: Obligation) -> Obligation:
    """Return the obligation that all of these hold in any run; its situation is that of the last one."""

    @obligation(*sorted({clause for one in each for clause in one.clauses}), of=whole_run)
    def holds_whatever_happens(run: Transcript) -> str:
        """Whatever its server and the user do, it sends, prints, cancels and ends as the clauses say."""
        situations = [one.judge(run) for one in each]
        return ", ".join(situations[-1])

    return holds_whatever_happens
