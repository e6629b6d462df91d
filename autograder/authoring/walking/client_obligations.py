"""What must hold of every run of a client of `walk_to`, whatever its server does and whoever types.

Each function is what an obligation of an exercise's model requires:

ends_as_it_went = obligation(3, 5, of=whole_run)(client_obligations.ends_as_it_went)
"""

from __future__ import annotations

import math
import re
from collections import Counter
from itertools import pairwise

from action_msgs.msg import GoalStatus

from autograder.authoring import client_checks
from autograder.authoring import events as ev
from autograder.authoring.action_client_checks import (
    NUMBER,
    has_number,
    how_to_give_up,
    why_it_left,
    why_not_this_status,
)
from autograder.authoring.failure import Failure, expect
from autograder.authoring.fields import expect_field
from autograder.authoring.missing import Missing
from autograder.authoring.scripted_goal import ScriptedGoal
from autograder.authoring.transcript import Transcript
from autograder.authoring.walking.client import (
    ABORTED,
    CANCELED,
    PATIENCE,
    SUCCEEDED,
    require_ending_line,
    require_reason,
    require_usage,
)
from autograder.authoring.walking.client_life import MARGIN, SURELY_WAITED, Cause, ClientLife, End, life_of

PROMPT = 0.5  # s from a feedback message to its line
PROMPT_SLACK = 0.5  # s on the arena's clock: 0.1 s of real time at scale 5, on a busy machine
ON_ITS_WAY = 0.3  # s that feedback may be overtaken by the result
ENDS_AT_ONCE = 10.0  # s
SOON = 1.0  # s in which a line about the answer to a cancel is printed
LONGEST = 60.0  # s; no scenario lasts so long
NO_CAUSE = "no reason to cancel"
TRACEBACK = "Traceback (most recent call last)"
REFUSED = re.compile(
    r"refus|reject|declin|den(?:y|ied)|(?:not|n't|cannot) (?:be )?cancel|fail|terminated|already|too late",
    re.IGNORECASE,
)
# What became of a goal, in the last line after Ctrl-C, by its final status; None: it has not ended.
BECAME = {
    GoalStatus.STATUS_SUCCEEDED: r"succe|arriv|reached|\bstatus\W+4\b",
    GoalStatus.STATUS_CANCELED: r"cancel|\bstatus\W+5\b",
    GoalStatus.STATUS_ABORTED: r"abort|\bstatus\W+6\b",
    None: r"\b(not|never|still|yet|without|unknown|unfinished|goes on|going on|gave up|no (end|result))\b|n't",
}
ROTATION = 0.0005  # rad, and of a quaternion's length, by which a goal may differ from the arguments
_ON_Q = (
    "Read stdin in a thread that sets an event; where you wait for the result, look at the event and call "
    "goal_handle.cancel_goal_async()."
)
_ON_AN_EARLY_Q = (
    "There is no goal handle yet to cancel with: remember the q, and look for it right after the acceptance."
)
ON_CTRL_C = (
    "rclpy shuts down at Ctrl-C, and then nothing can be sent: rclpy.init(signal_handler_options="
    "SignalHandlerOptions.NO), catch the signal yourself, and call cancel_goal_async()."
)


# -- what it sends ----------------------------------------------------------------------------------------------------


def sends_one_goal(run: Transcript) -> str | None:
    """It sends one goal, at x, y and yaw of its arguments, in frame odom."""
    goal = life_of(run).goal
    return require_pose(run, goal, "target_pose") if goal else None


def require_pose(run: Transcript, goal: ScriptedGoal, field: str) -> str:
    """Require that the pose in a field of the goal is that of the program's arguments; return which YAW they have."""
    arguments = run.params["arguments"]
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
        abs(math.remainder(heading - yaw, math.tau)) < ROTATION and abs(length - 1.0) < ROTATION,
        expected=f"a quaternion that turns by {yaw:g} rad about z",
        observed=f"x {rotation.x:.3f}, y {rotation.y:.3f}, z {rotation.z:.3f}, w {rotation.w:.3f}",
        help="orientation.z = math.sin(yaw / 2) and orientation.w = math.cos(yaw / 2); without a yaw, w is 1.0.",
        at=at,
    )
    return "without YAW" if len(arguments) == 2 else "YAW < 0" if yaw < 0 else "YAW ≥ 0"


def asks_to_cancel_in_time(run: Transcript) -> str | None:
    """It asks to cancel its goal when it has to, and never otherwise: at a q once, at Ctrl-C, after 5 s of silence."""
    life = life_of(run)
    if life.goal is None:
        return None
    causes = life.causes()
    asked_for_q = 0
    for number, cancel in enumerate(life.goal.cancels, start=1):
        t = cancel.received.t
        due = [cause for cause in causes if cause.since <= t]
        if not due:
            raise _needless(life, t, causes)
        expect(
            cancel.received.goal == life.goal.name,
            expected="a request to cancel this goal",
            observed="one without an id, which cancels the goals of all clients",
            help="Call cancel_goal_async() of the goal handle that you were given.",
            at=t,
        )
        asked_for_q += all(cause.once for cause in due)
        expect(
            asked_for_q <= 1,
            expected="one request to cancel the goal",
            observed=f"{number}",
            help="Remember that you have asked: the server works on the first request already.",
            at=t,
        )
    asked = [cancel.received.t for cancel in life.goal.cancels]
    for cause in causes:
        if cause.is_owed and cause.since <= life.exited and not any(t <= cause.latest for t in asked):
            raise _owed(life, cause, asked)
    return " and ".join(cause.name for cause in causes) or NO_CAUSE


def _needless(life: ClientLife, t: float, causes: list[Cause]) -> Failure:
    """Return the failure for a request to cancel that came when nothing asked for it."""
    assert life.goal is not None
    heard = max([life.goal.received.t, *(each for each in [*life.heard] if each <= t)])
    typed = [event.line for event in life.run.all(ev.NodeTyped) if event.t <= t]
    if typed and "q" not in typed:
        line = "the end of the input" if typed[-1] is None else f"the line “{typed[-1]}”"
        return Failure(
            expected="no request to cancel: nobody has typed q",
            observed=f"one came after {line}",
            help="Cancel when a line, without its newline, is q and nothing else; at the end of the input do nothing.",
            at=t,
        )
    if not causes or causes[0].name == "silence":
        return Failure(
            expected=f"no request to cancel, but {PATIENCE:g} s after it last heard of the server",
            observed=f"one came {t - heard:.1f} s after it",
            help="Cancel only when you are asked to, or in silence: a goal may take its time, and the last sign of "
            f"life came at {heard:.1f} s.",
            at=t,
        )
    return Failure(
        expected=f"the goal to go on until you {'type q' if causes[0].name == 'q' else 'press Ctrl-C'}",
        observed=f"a request to cancel {causes[0].since - t:.1f} s before",
        help="Cancel only when a line is q, when Ctrl-C is pressed, or when nothing has been heard for 5 s.",
        at=t,
    )


def _owed(life: ClientLife, cause: Cause, asked: list[float]) -> Failure:
    """Return the failure for a request to cancel that did not come, or late."""
    early = life.asked and life.asked[0] < life.accepted
    helps = {"q": _ON_AN_EARLY_Q if early else _ON_Q, "Ctrl-C": ON_CTRL_C}
    return Failure(
        expected=f"a request to cancel the goal, because {cause.because}",
        observed=f"the first {asked[0] - cause.since:.1f} s after it"
        if asked
        else "none: the robot walks on, and nobody watches it",
        help=helps.get(cause.name) or how_to_give_up(life.run),
        at=asked[0] if asked else life.run.end,
    )


def asks_for_its_result(run: Transcript) -> str | None:
    """It asks for the result before the server, which keeps it for a while, has forgotten it."""
    life = life_of(run)
    kept_for = (run.params.get("server") or {}).get("kept_for")
    if kept_for is None or life.goal is None or life.goal.finished is None:
        return None
    asked, forgotten = life.goal.result_requested, life.goal.finished.t + kept_for
    expect(
        asked is not None and asked.t < forgotten,
        expected=f"a request for the result before the server forgets it, at {forgotten:.1f} s",
        observed=f"the first at {asked.t:.1f} s" if asked else "none",
        help="Call get_result_async() right after the acceptance; its future is done when the goal ends.",
        at=forgotten,
    )
    return f"kept for {kept_for:g} s"


# -- how it ends ------------------------------------------------------------------------------------------------------


def ends_as_it_went(run: Transcript) -> str:
    """Its exit status says how the goal ended, or what came instead, and it ends neither early nor late."""
    life = life_of(run)
    ends = life.ends()
    exited = _require_end(life)
    told = [end for end in ends if end.status == exited.returncode]
    if exited.returncode >= 0 and exited.t < min(end.earliest for end in told or ends):
        raise _left_early(life, ends[0], exited)
    if not told:
        observed, help = why_not_this_status(run, exited, ends[-1].help)
        expected = f"exit status {ends[-1].status}: {ends[-1].because}"
        raise Failure(expected=expected, observed=observed, help=help, at=exited.t)
    latest = max(end.latest for end in told)
    expect(
        exited.t <= latest,
        expected=f"the end soon after {told[0].because}, at {latest:.1f} s at the latest",
        observed=f"it ended at {exited.t:.1f} s",
        help="Give each wait a limit, counted from its beginning: for the result at most 5 s after Ctrl-C, and for the "
        "answer to a cancel, too.",
        at=exited.t,
    )
    return told[0].name


def _require_end(life: ClientLife) -> ev.NodeExited:
    """Require that the program ended by itself, and not with a traceback."""
    run = life.run
    exited = client_checks.require_end(run, LONGEST)
    if TRACEBACK not in run.output("stderr"):
        return exited
    if exited.t < min(end.earliest for end in life.ends()):
        raise Missing(
            run,
            expected="a client that follows the goal to its end",
            never=f"at {exited.t:.1f} s it was gone already",
        )
    raise Failure(
        expected="one line that says how it ended",
        observed=f"a traceback: {run.last_words}",
        help="An expected end is no crash: catch the exception, print one line, return the status.",
        at=exited.t,
    )


def _left_early(life: ClientLife, end: End, exited: ev.NodeExited) -> Failure:
    """Return the failure for a program that ended before it could know how."""
    if life.goal and life.goal.is_accepted:
        return Failure(
            expected="a client that follows the goal to its end",
            observed=f"it ended with status {exited.returncode} at {exited.t:.1f} s, while the goal was under way",
            help=why_it_left(life.goal, exited),
            at=exited.t,
        )
    since = life.goal.received.t if life.goal else life.started
    return Failure(
        expected=f"{PATIENCE:g} s of waiting: {end.because}",
        observed=f"it gave up after {exited.t - since:.1f} s",
        help=end.help if life.goal else "Call wait_for_server(timeout_sec=5.0) before you send the goal.",
        at=exited.t,
    )


def says_how_it_ended(run: Transcript) -> str | None:
    """One line says how it ended: with status 0 and 4 on stdout, else on stderr; error_msg is in no other line."""
    life = life_of(run)
    exited = client_checks.require_end(run, LONGEST)
    told = [end for end in life.ends() if end.status == exited.returncode]
    if not told:
        return None  # its exit status is wrong, which is another obligation's
    finished = life.goal.finished if life.goal else None
    if any(end.name == "Ctrl-C" for end in told):
        _require_what_became(life, exited)
    elif exited.returncode == SUCCEEDED and finished:
        _require_final_pose(run, finished, require_ending_line(run, "SUCCEEDED", exited.t))
    elif exited.returncode == CANCELED and finished:
        require_ending_line(run, "CANCELED", exited.t, since=_said_of_the_end(life, finished))
    else:
        _require_reason_on_stderr(run, min(end.earliest for end in told), exited)
        if exited.returncode == ABORTED and finished and finished.result.error_msg:
            require_reason(run, finished)
    _require_no_other_ending(life, exited)
    return told[0].name


def _said_of_the_end(life: ClientLife, finished: ev.GoalFinished) -> float:
    """Return from when (s) CANCELED is said of the goal's end: of a request to cancel it may be said, too."""
    assert life.goal is not None
    if not life.asked:
        return 0.0
    agreed = [cancel.reply.t for cancel in life.goal.cancels if cancel.reply and cancel.reply.canceling]
    said = [event for event in life.run.all(ev.NodeOutput) if "CANCELED" in event.text.upper()]
    if said and any(t > finished.t - SOON for t in agreed):
        return said[-1].t  # both came together
    return finished.t - 0.1


def _require_no_other_ending(life: ClientLife, exited: ev.NodeExited) -> None:
    """Require that no line on stdout names the end that was not the goal's, unless somebody asked for it."""
    other = {SUCCEEDED: "CANCELED", CANCELED: "SUCCEEDED"}.get(exited.returncode)
    if other is None or life.asked or life.interrupted < math.inf:
        return
    lines = [
        line for line in life.run.output("stdout").splitlines() if re.search(rf"\b{other}\b", line, re.I)
    ]
    expect(
        not lines,
        expected="no line on stdout that names another end",
        observed=f"“{lines[0]}”" if lines else "",
        help="Print how the goal ended when response.status has told you, and only that.",
        at=exited.t,
    )


def _require_final_pose(run: Transcript, finished: ev.GoalFinished, line: str) -> None:
    position = finished.result.final_pose.pose.position
    for name, value in (("x", position.x), ("y", position.y)):
        expect(
            has_number(line, value),
            expected=f"the final {name}, {value:.2f} m, in the line that says how it ended",
            observed=f"“{line}”",
            help="Print response.result.final_pose.pose.position, not what you asked for: the robot says where it is.",
            at=run.end,
        )


def _require_reason_on_stderr(run: Transcript, since: float, exited: ev.NodeExited) -> None:
    lines = [
        event.text
        for event in run.all(ev.NodeOutput)
        if event.stream == "stderr" and event.t >= since - MARGIN and event.text.strip()
    ]
    expect(
        bool(lines),
        expected="one line on stderr that says how it ended",
        observed=f"the last line on stderr came before: {run.last_words}"
        if run.last_words
        else "nothing on stderr",
        help="print(..., file=sys.stderr) before the program ends.",
        at=exited.t,
    )


def _require_what_became(life: ClientLife, exited: ev.NodeExited) -> None:
    """Require a line on stdout, after the goal's end or the last one, that says what became of it after Ctrl-C."""
    finished = life.goal.finished if life.goal else None
    status = finished.status if finished and life.result <= exited.t else None
    since = life.result - 0.1 if status else life.interrupted
    lines = [
        event
        for event in life.run.all(ev.NodeOutput)
        if event.stream == "stdout" and event.text.strip() and event.t >= life.interrupted - 0.1
    ]
    said = [line.text for line in lines if line.t >= since or line is lines[-1]]
    late = status and life.result > life.interrupted + SURELY_WAITED
    ways = [BECAME[status], BECAME[None]] if late else [BECAME[status]]
    name = {
        GoalStatus.STATUS_SUCCEEDED: "it SUCCEEDED all the same",
        GoalStatus.STATUS_ABORTED: "it was ABORTED all the same",
        GoalStatus.STATUS_CANCELED: "it was CANCELED",
        None: "it has not ended yet",
    }[status]
    expect(
        any(re.search(way, line, re.IGNORECASE) for way in ways for line in said),
        expected=f"a line on stdout at the end that says what became of the goal: {name}",
        observed=f"the last line on stdout after Ctrl-C: {lines[-1].text if lines else 'none'}",
        help="After Ctrl-C, too, print a line when the goal has ended, by its status, or when you have waited long "
        "enough.",
        at=exited.t,
    )


def follows_its_goal(run: Transcript) -> str:
    """It cancels its goal when it must, and ends in time with the status and the line that say how it went."""
    canceled = asks_to_cancel_in_time(run)
    ended = ends_as_it_went(run)
    says_how_it_ended(run)
    return ended if canceled in (None, ended, NO_CAUSE) else f"{ended}, {canceled}"


# -- what it prints on the way ----------------------------------------------------------------------------------------


def prints_each_feedback(run: Transcript, within: float = math.inf) -> str | None:
    """For each feedback it prints one line on stdout with distance_remaining, and no such line for anything else."""
    life = life_of(run)
    if life.goal is None:
        return None
    finished = life.goal.finished.t if life.goal.finished else math.inf
    due = min([finished, *(end.earliest for end in life.ends())])  # from when on the program may end
    over = min(life.exited, due - ON_ITS_WAY)
    sent = [each for each in life.goal.feedback if life.accepted <= each.t < over]
    lines = [event for event in run.all(ev.NodeOutput) if event.stream == "stdout"]
    rest = iter(lines)
    forms: Counter[str] = Counter()
    for each in sent:
        distance = each.feedback.distance_remaining
        line = next(
            (line for line in rest if line.t > each.t - 0.1 and has_number(line.text, distance)), None
        )
        if line is None:
            raise _not_printed(distance, each.t, lines)
        forms[_form(line.text)] += 1
        expect(
            line.t - each.t <= within + PROMPT_SLACK,
            expected=f"a line with {distance:.2f} at most {within:g} s after the feedback",
            observed=f"it came {line.t - each.t:.1f} s after it",
            help="Something holds up the thread that spins, most likely the reading of stdin: input() and readline() "
            "wait for a whole line. Give it a thread of its own.",
            at=each.t,
        )
    alike = [line for line in lines if _form(line.text) in forms]
    expect(
        len(alike) <= len(life.goal.feedback),
        expected=f"one line for each feedback, {len(life.goal.feedback)} in all",
        observed=f"{len(alike)}: " + " | ".join(line.text[:80] for line in alike[-3:]),
        help="Print one line for each feedback, in the feedback callback and nowhere else.",
        at=alike[-1].t if alike else None,
    )
    return _how_it_came(life, [each.t for each in sent]) if sent else None


def _not_printed(distance: float, at: float, lines: list[ev.NodeOutput]) -> Failure:
    return Failure(
        expected=f"a line for each feedback with distance_remaining: a line with {distance:.2f}",
        observed=" | ".join(line.text for line in lines[:6]) or "nothing on stdout",
        help="Give send_goal_async a feedback_callback; the action's message is in message.feedback, so print "
        "message.feedback.distance_remaining.",
        at=at,
    )


def _form(line: str) -> str:
    """Return a line without its numbers: the lines of a program's feedback have one form."""
    return NUMBER.sub("#", line)


def _how_it_came(life: ClientLife, times: list[float]) -> str:
    gaps = [later - earlier for earlier, later in pairwise(times)]
    came = "up to 4.5 s apart" if any(gap > 1.5 for gap in gaps) else "each 0.2 s"
    if life.interrupted < times[-1]:
        return f"{came}, also after Ctrl-C"
    return f"{came}, also after a q" if life.asked and life.asked[0] < times[-1] else came


def prints_feedback_in_time(run: Transcript) -> str | None:
    """Each feedback is printed within 0.5 s, whether somebody types or not."""
    return prints_each_feedback(run, PROMPT)


def says_what_was_refused(run: Transcript) -> str | None:
    """A line says that a cancel was refused, whatever the return_code: goals_canceling is empty."""
    life = life_of(run)
    cancels = life.goal.cancels if life.goal and life.asked else []
    found = [
        cancel.reply
        for cancel in cancels[:1]
        if cancel.reply
        and not cancel.reply.canceling
        and cancel.received.t < life.interrupted
        and cancel.reply.t < min(life.result - ON_ITS_WAY, life.exited)
    ]
    for reply in found:
        lines = [
            event.text
            for event in run.all(ev.NodeOutput)
            if reply.t - 0.05 <= event.t <= min(life.exited, run.end)
        ]
        others = [line for line in lines if not NUMBER.search(line)]
        expect(
            any(REFUSED.search(line) for line in lines),
            expected="a line with the word refused, because goals_canceling is empty "
            f"(return_code {reply.return_code})",
            observed=" | ".join((others or lines)[:4]) or "nothing was printed meanwhile",
            help="Look into the answer of cancel_goal_async(): return_code 0 says only that the request was "
            "understood. The goal is being cancelled if it is in goals_canceling; every other answer is a refusal, "
            "whatever its return_code.",
            at=reply.t,
        )
    return ", ".join(f"refused with code {reply.return_code}" for reply in found) or None


# -- before it starts -------------------------------------------------------------------------------------------------


def refuses_what_is_no_pose(run: Transcript) -> str:
    """Wrong arguments end it with status 2 and the usage on stderr, before a node is started."""
    require_usage(run, ENDS_AT_ONCE)
    return " ".join(run.params["arguments"])
