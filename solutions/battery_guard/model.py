"""What must hold of every run of the guard, whatever battery, server and robot do: what it sends, cancels and says."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator
from functools import partial

from autograder.authoring import Failure, Obligation, ev, expect, how_to_give_up, obligation, shown, whole_run
from autograder.authoring.walking import client_ends
from autograder.authoring.walking import client_obligations as owed
from autograder.authoring.walking.client_run import CANCELED, SUCCEEDED, Cause, End

from .life import BATTERY, KNOWN, LIMIT, GuardLife, about_level, guards, is_percentage

# -- what it sends ----------------------------------------------------------------------------------------------------


sends_one_goal = obligation(4, 18, of=guards, see="06_walk_to_a_pose#client-intro")(owed.sends_one_goal)


@obligation(1, 3, of=guards, see="08_navigation#guard-intro")
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
    return owed.require_cancels_in_time(life, _needless, _how_to_cancel)


def _needless(life: GuardLife, t: float) -> Failure:
    """Return the failure for a request to cancel that came when nothing asked for it."""
    said = [event.message.percentage for event in life.run.published(BATTERY) if event.t < t]
    last = said[-1] if said else math.inf
    help, see = "Cancel only for a percentage below 0.20, for Ctrl-C, or when nothing was heard for 5 s.", ""
    if not is_percentage(last):
        help, see = about_level(last), "08_navigation#guard-traps-why"
    elif last <= LIMIT + 0.01:
        help, see = about_level(last), "08_navigation#float-why"
    return Failure(
        expected="no request to cancel: no percentage was below 0.20",
        observed=f"one came when the percentage was {f'{last:.4f}' if is_percentage(last) else shown(last)}",
        help=help,
        at=t,
        see=see,
    )


def _how_to_cancel(life: GuardLife, cause: Cause) -> str:
    """Say what to do about a request to cancel that did not come, or late."""
    low = next((low for low in life.lows if max(low.since, life.accepted) == cause.since), None)
    if cause.name == "Ctrl-C":
        return owed.ON_CTRL_C
    if cause.name == "silence" or low is None:
        return how_to_give_up(life.run)
    if low.subscriptions == 0:
        return (
            f'create_subscription(BatteryState, "{BATTERY}", …): a relative name, and keep it until the end.'
        )
    if low.since < life.accepted:
        return (
            "Without a goal handle nothing can be cancelled, so remember that the battery is low, and look at it "
            "when you have the handle. No new message need come."
        )
    if low.level == 0.0 or low.level > 0.19:
        return about_level(low.level)
    return (
        "Look at the battery while you wait for the result: spin in short pieces, and after each compare the last "
        "percentage with 0.20."
    )


def asks_to_cancel(life: GuardLife) -> Iterator[tuple[int, str]]:
    """Judge that it cancels when it has to, once, and never otherwise; yield the clauses that ask for it, and why."""
    for cause in _require_cancels(life) if life.goal else []:
        early = cause.name == "battery" and cause.since == life.accepted
        if cause.is_required:
            yield {"silence": 14, "Ctrl-C": 16}.get(cause.name, 6 if early else 5), cause.because


def _obligation(
    judge: Callable[[GuardLife], Iterator[tuple[int, str]]], sentence: str, *clauses: int
) -> Obligation:
    """Make an obligation of a judgement, for the situations of these clauses."""

    def require(life: GuardLife) -> str | None:
        situations = [situation for clause, situation in judge(life) if clause in clauses]
        return situations[0] if situations else None

    return Obligation(judge.__name__, sentence, clauses, guards, require)


_cancels = partial(_obligation, asks_to_cancel)
cancels_when_low = _cancels("A percentage below 0.20 cancels the goal within 1 s, once", 5)
cancels_when_accepted = _cancels("A battery that is low at the acceptance cancels the goal right after it", 6)
cancels_at_ctrl_c = _cancels("Ctrl-C cancels the goal", 16)


@obligation(7, of=guards, see="06_walk_to_a_pose#follow-task")
def compares_exactly(life: GuardLife) -> str | None:
    """Whatever the percentages were, the goal goes on down to 0.20 and is cancelled below it"""
    if life.goal is None or life.accepted == math.inf:
        life.ends()  # says so if the goal had to be sent
        return None
    _require_cancels(life)
    if not life.goal.cancels:
        client_ends.require_patience(life, life.ends())  # a goal that it left does not show that it goes on
    levels = [event.message.percentage for event in life.levels if event.t < life.exited]
    high, low = [level for level in levels if level >= LIMIT], [level for level in levels if level < LIMIT]
    said = [f"goes on at {min(high):.4g}"] if high else []
    said += [f"cancelled at {max(low):.4g}"] if low else []
    return ", ".join(said)


@obligation(8, of=guards, see="08_navigation#guard-traps-why")
def ignores_what_is_none(life: GuardLife) -> str | None:
    """NaN and numbers outside 0 to 1 are ignored, and one line on stderr tells of all of them together"""
    if not life.ignored:
        return None
    if life.goal:
        _require_cancels(life)
    client_ends.require_patience(life, life.ends())
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


def ends_as_it_went(life: GuardLife) -> Iterator[tuple[int, str]]:
    """Judge that it ends as it went, in time and with the right line; yield the clauses that say so, and how."""
    ends, _ = _require_ending(life)
    if any(end.name == "silence" for end in ends):
        _require_cancels(life)
    for end in ends:
        yield _which(life, end)


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
    """Require a right end, and with status 0 and 4 the line on stdout that says which it is."""
    right, exited = client_ends.require_ending(life)
    if exited.returncode not in (SUCCEEDED, CANCELED):
        return right, exited
    name = right[0].name if len({end.name for end in right}) == 1 else ""
    if name in ("SUCCEEDED", "CANCELED"):
        client_ends.require_ending_line(life.run, name, exited.t)
        return right, exited
    word = "battery" if name == "low before" else ""
    expect(
        bool(re.search(word or r"\S", life.run.output("stdout"), re.IGNORECASE)),
        expected=f"a line on stdout that says how it ended{f', with the word {word}' if word else ''}",
        observed=f"“{life.run.output('stdout')[:200]}”",
        help="Say why there is no walk, or why it has no end yet: print a line before the program ends.",
        at=exited.t,
    )
    return right, exited


_ends = partial(_obligation, ends_as_it_went)
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


@obligation(13, 15, of=guards, see="06_walk_to_a_pose#hopeful-why")
def says_why(life: GuardLife) -> str | None:
    """With status 1, 2 and 3 one line on stderr says why; after ABORTED, error_msg is in it and nowhere else"""
    right, exited = _require_ending(life)
    if exited.returncode in (SUCCEEDED, CANCELED):
        return None
    client_ends.require_reason(life, right, exited)
    return right[0].because


refuses_what_is_no_pose = obligation(17, of=whole_run, see="03_clients_that_survive#fix-frame")(
    owed.refuses_what_is_no_pose
)

EVERYTHING = (
    *(sends_it_only_when_it_may, sends_one_goal, compares_exactly, ignores_what_is_none),
    *(waits_for_canceled_and_standing, says_why),
)


@obligation(
    *sorted({clause for each in EVERYTHING for clause in each.clauses}),
    of=guards,
    see="08_navigation#guard-traps-why",
)
def holds_whatever_happens(life: GuardLife) -> str:
    """Whatever the battery, the server and the robot do, and when Ctrl-C is pressed, every clause holds"""
    for each in EVERYTHING:
        each.require(life)
    ends, _ = _require_ending(life)
    return _which(life, ends[0])[1]
