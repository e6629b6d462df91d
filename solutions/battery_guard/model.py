"""What must hold of every run of the guard, whatever battery, server and robot do: what it sends, cancels and says."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable

from autograder.authoring import client_checks
from autograder.authoring import events as ev
from autograder.authoring.action_client_checks import how_to_give_up, why_it_left, why_not_this_status
from autograder.authoring.failure import Failure, expect
from autograder.authoring.fields import shown
from autograder.authoring.obligation import Obligation, obligation, whole_run
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
from autograder.authoring.walking.client_life import MARGIN, Cause, End
from autograder.authoring.walking.client_obligations import (
    ENDS_AT_ONCE,
    LONGEST,
    ON_CTRL_C,
    TRACEBACK,
    require_pose,
)

from .life import BATTERY, KNOWN, LIMIT, WAIT_FOR_STANDING, GuardLife, about_level, guards, is_percentage

LOOKS_AWAY = (
    "Look at the battery while you wait for the result: spin in short pieces, and after each compare the last "
    "percentage with 0.20."
)
EARLY = (
    "Without a goal handle nothing can be cancelled, so remember that the battery is low, and look at it "
    "when you have the handle. No new message need come."
)
NO_SUBSCRIPTION = (
    f'create_subscription(BatteryState, "{BATTERY}", …): a relative name, and keep it until the end.'
)


# -- what it sends ----------------------------------------------------------------------------------------------------


@obligation(4, 18, of=guards)
def sends_one_goal(life: GuardLife) -> str | None:
    """The goal it sends is at x, y and yaw of its arguments, in frame odom"""
    if life.goal is None:
        life.ends()  # says so if the goal had to be sent
        return None
    return require_pose(life.run, life.goal, "pose")


@obligation(1, 3, of=guards)
def sends_it_only_when_it_may(life: GuardLife) -> str:
    """It sends no goal before it knows a percentage, and none while the last percentage is below 0.20"""
    lows = [low for low in life.lows if low.since < life.exited]
    if life.goal is None:
        return "none: the battery was low" if lows else "none: no percentage or no server"
    t = life.goal.received.t
    first = life.levels[0].t if life.levels else math.inf
    expect(
        first <= t,
        expected=f"no goal before the first percentage on {BATTERY}",
        observed="a goal was sent, and no percentage had come"
        + ("" if first == math.inf else f" until {first - t:.1f} s later"),
        help=f"Wait for the first {BATTERY} before you send the goal: an unknown battery is no full one, and a message "
        "that you ignore counts as none.",
        at=t,
    )
    for low in lows:
        expect(
            not low.since < t - KNOWN < t < low.until,
            expected=f"no goal: the battery was at {low.level:.4g}",
            observed=f"a goal {t - low.since:.1f} s after this was published",
            help="Look at the last percentage just before you send the goal: below 0.20, print a line and return 4. "
            "wait_for_server() does not spin, so no message reaches you meanwhile: look at server_is_ready() between "
            "spins.",
            at=t,
        )
    return "sent"


# -- what it cancels --------------------------------------------------------------------------------------------------


def _require_cancels(life: GuardLife) -> list[Cause]:
    """Require a request to cancel for what asks for one, and none otherwise; return what asked."""
    assert life.goal is not None
    causes = life.causes()
    asked = [cancel.received.t for cancel in life.goal.cancels]
    for number, cancel in enumerate(life.goal.cancels, start=1):
        t = cancel.received.t
        due = {cause.name for cause in causes if cause.since <= t}
        if not due:
            raise _needless(life, t)
        expect(
            cancel.received.goal == life.goal.name,
            expected="a request to cancel this goal",
            observed="one without an id, which cancels the goals of all clients",
            help="Call cancel_goal_async() of the goal handle that you were given.",
            at=t,
        )
        expect(
            number <= len(due),
            expected="one request to cancel the goal",
            observed=f"{number}, the last {t - asked[0]:.1f} s after the first",
            help="Remember that you have asked: the server works on the first request already.",
            at=t,
        )
    for cause in causes:
        if cause.is_owed and not any(t <= cause.latest for t in asked):
            raise _owed(life, cause, asked)
    return causes


def _needless(life: GuardLife, t: float) -> Failure:
    """Return the failure for a request to cancel that came when nothing asked for it."""
    said = [event.message.percentage for event in life.run.published(BATTERY) if event.t < t]
    last = said[-1] if said else math.inf
    is_strange = not LIMIT + 0.01 < last <= 1.0
    return Failure(
        expected="no request to cancel: no percentage was below 0.20",
        observed=f"one came when the percentage was {f'{last:.4f}' if is_percentage(last) else shown(last)}",
        help=about_level(last)
        if is_strange
        else "Cancel only for a percentage below 0.20, for Ctrl-C, or when nothing was heard for 5 s.",
        at=t,
        see=("08_navigation#float-why" if is_percentage(last) else "08_navigation#guard-traps-why")
        if is_strange
        else "",
    )


def _owed(life: GuardLife, cause: Cause, asked: list[float]) -> Failure:
    """Return the failure for a request to cancel that did not come, or late."""
    low = next((low for low in life.lows if max(low.since, life.accepted) == cause.since), None)
    if cause.name == "battery" and low:
        deaf, near = low.subscriptions == 0, low.level == 0.0 or low.level > 0.19
        early = low.since < life.accepted
        help = NO_SUBSCRIPTION if deaf else EARLY if early else about_level(low.level) if near else LOOKS_AWAY
    else:
        help = ON_CTRL_C if cause.name == "Ctrl-C" else how_to_give_up(life.run)
    exited = life.run.first(ev.NodeExited)
    gone = f"none; the program ended at {exited.t:.1f} s" if exited else "none: the robot walks on"
    return Failure(
        expected=f"a request to cancel the goal: {cause.because}",
        observed=f"the first {asked[0] - cause.since:.1f} s after it" if asked else gone,
        help=help,
        at=asked[0] if asked else life.run.end,
    )


def _cancels(clause: int, sentence: str) -> Obligation:
    """Make the obligation that it cancels when it has to, once, and never otherwise, as a clause says it of a cause."""

    def asks_to_cancel(life: GuardLife) -> str | None:
        if life.goal is None:
            return None
        found = [
            situation for cause in _require_cancels(life) for situation in [_situation(life, cause, clause)]
        ]
        return ", ".join(filter(None, found)) or None

    asks_to_cancel.__doc__ = sentence
    return obligation(clause, of=guards)(asks_to_cancel)


def _situation(life: GuardLife, cause: Cause, clause: int) -> str:
    """Return the situation in which a cause was judged, if it is the clause's."""
    early = cause.name == "battery" and cause.since == life.accepted
    of = {"silence": 14, "Ctrl-C": 16}.get(cause.name, 6 if early else 5)
    return cause.because if of == clause and cause.is_owed else ""


cancels_when_low = _cancels(5, "A percentage below 0.20 cancels the goal within 1 s, once")
cancels_when_accepted = _cancels(6, "A battery that is low at the acceptance cancels the goal right after it")
cancels_at_ctrl_c = _cancels(16, "Ctrl-C cancels the goal")


@obligation(7, of=guards)
def compares_exactly(life: GuardLife) -> str | None:
    """Whatever the percentages were, the goal goes on down to 0.20 and is cancelled below it"""
    if life.goal is None or life.accepted == math.inf:
        life.ends()  # says so if the goal had to be sent
        return None
    _require_cancels(life)
    levels = [event.message.percentage for event in life.levels if event.t < life.exited]
    said = [f"goes on at {min(each):.4g}" for each in [[x for x in levels if x >= LIMIT]] if each]
    said += [f"cancelled at {max(each):.4g}" for each in [[x for x in levels if x < LIMIT]] if each]
    return ", ".join(said)


@obligation(8, of=guards)
def ignores_what_is_none(life: GuardLife) -> str | None:
    """NaN and numbers outside 0 to 1 are ignored, and one line on stderr tells of all of them together"""
    if not life.ignored:
        return None
    if life.goal:
        _require_cancels(life)
    _require_patience(life, life.ends())
    lines = [line for line in life.run.output("stderr").splitlines() if re.search(r"warn|ignor", line, re.I)]
    known = life.ignored[0].t < min(life.exited, life.result) - KNOWN
    exited = life.run.first(ev.NodeExited)
    says_why = exited is not None and exited.returncode not in (SUCCEEDED, CANCELED)  # in such words, too
    expect(
        known <= len(lines) <= 1 + says_why,
        expected="one line on stderr with WARN or “ignored”, for all of these messages together",
        observed=f"{len(lines)}" + (": " + " | ".join(lines[:2]) if lines else ""),
        help='self.get_logger().warning("…", once=True) prints a line the first time, and nothing after that.',
        at=life.run.end,
    )
    return ", ".join(sorted({_kind(event.message.percentage) for event in life.ignored})) if known else None


def _kind(level: float) -> str:
    return "NaN" if math.isnan(level) else "below 0" if level < 0 else "above 1"


# -- how it ends ------------------------------------------------------------------------------------------------------

SILENCE, CTRL_C = 14, 16  # clauses
BEFORE = {  # the clause that an end is about, whatever came before
    "no percentage": 1,
    "no server": 2,
    "low before": 3,
    "rejected": 13,
    "no answer": SILENCE,
    "silence": SILENCE,
    "no CANCELED": 10,
    "no STANDING": 10,
}


def _ends(sentence: str, *clauses: int) -> Obligation:
    """Make the obligation that it ends as it went, in time and with the right line, as clauses say it of an end."""

    def ends_as_it_went(life: GuardLife) -> str | None:
        ends, _ = _require_ending(life)
        if SILENCE in clauses and life.accepted < math.inf:
            _require_cancels(life)
        found = [situation for end in ends for of, situation in [_which(life, end)] if of in clauses]
        return found[0] if found else None

    ends_as_it_went.__doc__ = sentence
    return obligation(*clauses, of=guards)(ends_as_it_went)


def _which(life: GuardLife, end: End) -> tuple[int, str]:
    """Return the clause that an end is about, and the situation."""
    why = next((cause.name for cause in life.reasons() if cause.since < end.at), "")
    if why == "Ctrl-C" and end.name != "silence":
        return CTRL_C, f"{end.name} after Ctrl-C"
    if end.name in BEFORE:
        return BEFORE[end.name], end.because
    if not why:
        return 12, end.name
    return (9 if end.name == "CANCELED" else 11), f"{end.name} after the battery got low"


def _require_ending(life: GuardLife) -> tuple[list[End], ev.NodeExited]:
    """Require one of the exit statuses that are right, in its time, and the line on stdout that belongs to it."""
    run, ends = life.run, life.ends()
    exited = client_checks.require_end(run, LONGEST)
    expect(
        TRACEBACK not in run.output("stderr"),
        expected="one line that says how it ended",
        observed=f"a traceback: {run.last_words}",
        help="An expected end is no crash: catch the exception, print one line, return the status.",
        at=exited.t,
    )
    right = [end for end in ends if end.status == exited.returncode]
    _require_patience(life, right or ends)
    if not right:
        observed, help = why_not_this_status(run, exited, ends[-1].help)
        expected = f"exit status {ends[-1].status}: {ends[-1].because}"
        raise Failure(expected=expected, observed=observed, help=help, at=exited.t)
    latest = max(end.latest for end in right)
    expect(
        exited.t <= latest,
        expected=f"the end soon after this: {right[-1].because}; at {latest:.1f} s at the latest",
        observed=f"it ended at {exited.t:.1f} s",
        help="Keep the last message of robot_state, with durability transient local, and look at it again after each "
        "spin. Give each wait after the cancel a limit of 5 s, counted from its beginning: feedback may go on.",
        at=exited.t,
    )
    if exited.returncode in (SUCCEEDED, CANCELED):
        _require_line_on_stdout(run, {end.name for end in right}, exited)
    return right, exited


def _require_patience(life: GuardLife, ends: list[End]) -> None:
    """Require that the program did not end by itself before it could know how."""
    exited = life.run.first(ev.NodeExited)
    if exited is None or exited.returncode < 0 or exited.t >= min(end.earliest for end in ends):
        return
    if life.goal is None:
        raise Failure(
            expected=f"{PATIENCE:g} s of waiting: {ends[0].because}",
            observed=f"it gave up after {exited.t - life.started:.1f} s",
            help=ends[0].help,
            at=exited.t,
        )
    if life.result <= exited.t and ends[0].status == CANCELED:
        raise Failure(
            expected="the end only when the goal is CANCELED and the robot stands",
            observed=f"it ended {exited.t - life.result:.1f} s after CANCELED, and robot_state did not say STANDING",
            help=WAIT_FOR_STANDING,
            at=exited.t,
        )
    raise Failure(
        expected="a client that follows the goal to its end",
        observed=f"it ended with status {exited.returncode} at {exited.t:.1f} s, while the goal was under way",
        help=why_it_left(life.goal, exited),
        at=exited.t,
    )


def _require_line_on_stdout(run: Transcript, ends: Iterable[str], exited: ev.NodeExited) -> None:
    """Require the line that says how it ended: with the status of the goal, or of the battery that was low before."""
    word = {"SUCCEEDED": "SUCCEEDED", "CANCELED": "CANCELED", "low before": "battery"}.get(" ".join(ends))
    if word and word != "battery":
        require_ending_line(run, word, exited.t)
        return
    expect(
        bool(re.search(word or r"\S", run.output("stdout"), re.IGNORECASE)),
        expected=f"a line on stdout that says how it ended{f', with the word {word}' if word else ''}",
        observed=f"“{run.output('stdout')[:200]}”",
        help="Say why there is no walk, or why it has no end yet: print a line before the program ends.",
        at=exited.t,
    )


gives_up_without_a_percentage = _ends("Without a percentage within 5 s it ends with status 1", 1)
gives_up_on_a_missing_server = _ends("Without a server within 5 s it ends with status 1", 2)
says_that_the_battery_is_low = _ends("A battery that is low before the goal ends it with status 4", 3)
waits_for_canceled_and_standing = _ends("After a cancel, CANCELED and STANDING end it, with status 4", 9)
waits_5_s_for_each = _ends("It waits for CANCELED, and for STANDING, at most 5 s", 10, CTRL_C)
believes_the_end = _ends("However a goal ends after a request to cancel it, its status says", 11, CTRL_C)
ends_with_the_goal = _ends("SUCCEEDED ends it with status 0, ABORTED with 3, CANCELED with 4", 12)
ends_in_silence = _ends(
    "5 s without an answer, or without feedback and result, end it with status 1", SILENCE
)
ends_after_ctrl_c = _ends("After Ctrl-C it waits for the goal's end, at most 5 s", CTRL_C)


@obligation(13, 15, of=guards)
def says_why(life: GuardLife) -> str | None:
    """With status 1, 2 and 3 one line on stderr says why; after ABORTED, error_msg is in it and nowhere else"""
    right, exited = _require_ending(life)
    if exited.returncode in (SUCCEEDED, CANCELED):
        return None
    since = min(end.earliest for end in right) - MARGIN
    lines = [event for event in life.run.all(ev.NodeOutput) if event.stream == "stderr" and event.t >= since]
    expect(
        any(line.text.strip() for line in lines),
        expected="one line on stderr that says why it ended",
        observed=f"the last before the end: {life.run.last_words or 'none'}",
        help="print(..., file=sys.stderr) before the program ends.",
        at=exited.t,
    )
    finished = life.goal.finished if life.goal else None
    if exited.returncode == ABORTED and finished and finished.result.error_msg:
        require_reason(life.run, finished)
    return right[0].because


@obligation(17, of=whole_run)
def refuses_what_is_no_pose(run: Transcript) -> str:
    """Wrong arguments end it with status 2 and the usage on stderr, before a node is started"""
    require_usage(run, ENDS_AT_ONCE)
    return " ".join(run.params["arguments"])


EVERYTHING = (
    *(sends_it_only_when_it_may, sends_one_goal, compares_exactly, ignores_what_is_none),
    *(waits_for_canceled_and_standing, says_why),
)


@obligation(*sorted({clause for each in EVERYTHING for clause in each.clauses}), of=guards)
def holds_whatever_happens(life: GuardLife) -> str:
    """Whatever the battery, the server and the robot do, and when Ctrl-C is pressed, every clause holds"""
    for each in EVERYTHING:
        each.require(life)
    ends, _ = _require_ending(life)
    return _which(life, ends[0])[1]
