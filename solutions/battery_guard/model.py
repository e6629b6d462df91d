"""What must hold for every run of the guard, whatever battery, server and robot do."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator
from functools import partial

from autograder.authoring import Failure, Obligation, ev, expect, how_to_give_up, obligation, shown, whole_run
from autograder.authoring.walking import client_ends
from autograder.authoring.walking import client_obligations as owed
from autograder.authoring.walking.client_run import CANCELED, SUCCEEDED, Cause, End

from .life import BATTERY, DELIVERY_TIME, LIMIT, GuardLife, about_level, guards, is_percentage

# -- the goal ---------------------------------------------------------------------------------------------------------


sends_one_goal = obligation(4, 18, of=guards, see="06_walk_to_a_pose#client-intro")(owed.sends_one_goal)


@obligation(1, 3, of=guards, see="08_navigation#guard-intro")
def sends_it_only_when_it_may(life: GuardLife) -> str:
    """It sends no goal before the first valid percentage, and none while the last percentage is below 0.20"""
    lows = [low for low in life.lows if low.since < life.exited]
    if life.goal is None:
        return "no goal: the battery was low" if lows else "no goal: no percentage or no server"
    t = life.goal.received.t
    first = life.levels[0].t if life.levels else math.inf
    expect(
        first <= t,
        expected=f"no goal before the first percentage on {BATTERY}",
        observed="a goal was sent without any percentage"
        if first == math.inf
        else f"a goal was sent {first - t:.1f} s before the first percentage",
        help=f"Before you send the goal, wait for the first {BATTERY} with a valid percentage: the battery may be low. "
        "A message whose percentage is invalid is not the first one.",
        at=t,
    )
    for low in lows:
        expect(
            not low.since < t - DELIVERY_TIME < t < low.until,
            expected=f"no goal, as the battery was at {low.level:.4g}",
            observed=f"a goal {t - low.since:.1f} s after that level was published",
            help="Check the last percentage just before you send the goal: if it is below 0.20, print a line and "
            "return 4. wait_for_server() does not spin, so no message is processed meanwhile: instead, spin and check "
            "server_is_ready() in a loop.",
            at=t,
        )
    return "sent"


# -- the cancel -------------------------------------------------------------------------------------------------------


def _require_cancels(life: GuardLife) -> list[Cause]:
    return owed.require_cancels_in_time(life, _needless, _how_to_cancel)


def _needless(life: GuardLife, t: float) -> Failure:
    """Return the failure for a cancel request without a reason."""
    said = [event.message.percentage for event in life.run.published(BATTERY) if event.t < t]
    last = said[-1] if said else math.inf
    help, see = "Cancel only at a percentage below 0.20, on Ctrl-C, or after 5 s without feedback.", ""
    if not is_percentage(last):
        help, see = about_level(last), "08_navigation#guard-traps-why"
    elif last <= LIMIT + 0.01:
        help, see = about_level(last), "08_navigation#float-why"
    return Failure(
        expected="no cancel request, as no percentage was below 0.20",
        observed=f"a cancel request when the percentage was {f'{last:.4f}' if is_percentage(last) else shown(last)}",
        help=help,
        at=t,
        see=see,
    )


def _how_to_cancel(life: GuardLife, cause: Cause) -> str:
    """Return advice on a cancel request that is missing or late."""
    low = next((low for low in life.lows if max(low.since, life.accepted) == cause.since), None)
    if cause.name == "Ctrl-C":
        return owed.ON_CTRL_C
    if cause.name == "silence" or low is None:
        return how_to_give_up(life.run)
    if low.subscriptions == 0:
        return (
            f'Write create_subscription(BatteryState, "{BATTERY}", …) with a relative name, and keep the subscription '
            "until the program exits."
        )
    if low.since < life.accepted:
        return (
            "The battery got low before you had the goal handle, and no further message may come. As soon as you have "
            "the handle, check the last percentage, and cancel."
        )
    if low.level == 0.0 or low.level > 0.19:
        return about_level(low.level)
    return (
        "Check the battery while you wait for the result: spin with a short timeout in a loop, and compare the last "
        "percentage with 0.20 after each spin."
    )


def asks_to_cancel(life: GuardLife) -> Iterator[tuple[int, str]]:
    """Require that it cancels once when it has to, and never otherwise; yield each cancel's clause and reason."""
    for cause in _require_cancels(life) if life.goal else []:
        early = cause.name == "battery" and cause.since == life.accepted
        if cause.is_required:
            yield {"silence": 14, "Ctrl-C": 16}.get(cause.name, 6 if early else 5), cause.because


def _obligation(
    judge: Callable[[GuardLife], Iterator[tuple[int, str]]], sentence: str, *clauses: int
) -> Obligation:
    """Make an obligation from a function that yields clauses and situations, for these clauses only."""

    def require(life: GuardLife) -> str | None:
        situations = [situation for clause, situation in judge(life) if clause in clauses]
        return situations[0] if situations else None

    return Obligation(judge.__name__, sentence, clauses, guards, require)


_cancels = partial(_obligation, asks_to_cancel)
cancels_when_low = _cancels("At a percentage below 0.20 it cancels the goal once, within 1 s", 5)
cancels_when_accepted = _cancels(
    "If the battery is low at acceptance, it cancels the goal right after that", 6
)
cancels_at_ctrl_c = _cancels("On Ctrl-C it cancels the goal", 16)


@obligation(7, of=guards, see="06_walk_to_a_pose#follow-task")
def compares_exactly(life: GuardLife) -> str | None:
    """The goal goes on at every percentage down to 0.20 and is cancelled below"""
    if life.goal is None or life.accepted == math.inf:
        life.ends()  # raises if the goal had to be sent
        return None
    _require_cancels(life)
    if not life.goal.cancels:
        # if it exited early, nothing shows that the goal goes on
        client_ends.require_patience(life, life.ends())
    levels = [event.message.percentage for event in life.levels if event.t < life.exited]
    high, low = [level for level in levels if level >= LIMIT], [level for level in levels if level < LIMIT]
    said = [f"goes on at {min(high):.4g}"] if high else []
    said += [f"cancelled at {max(low):.4g}"] if low else []
    return ", ".join(said)


@obligation(8, of=guards, see="08_navigation#guard-traps-why")
def ignores_what_is_none(life: GuardLife) -> str | None:
    """NaN and numbers outside 0 to 1 are ignored, with one warning on stderr for all of them"""
    if not life.ignored:
        return None
    if life.goal:
        _require_cancels(life)
    client_ends.require_patience(life, life.ends())
    lines = [line for line in life.run.output("stderr").splitlines() if re.search(r"warn|ignor", line, re.I)]
    known = life.ignored[0].t < min(life.exited, life.result) - DELIVERY_TIME
    exited = life.run.first(ev.NodeExited)
    says_why = exited is not None and exited.returncode not in (SUCCEEDED, CANCELED)  # in such words, too
    expect(
        known <= len(lines) <= 1 + says_why,
        expected="one line on stderr with WARN or “ignored” for all invalid percentages together",
        observed=f"{len(lines)} lines" + (": " + " | ".join(lines[:2]) if lines else ""),
        help='Use self.get_logger().warning("…", once=True), which logs only the first time.',
        at=life.run.end,
    )
    return ", ".join(sorted({_kind(event.message.percentage) for event in life.ignored})) if known else None


def _kind(level: float) -> str:
    return "NaN" if math.isnan(level) else "below 0" if level < 0 else "above 1"


# -- the exit ---------------------------------------------------------------------------------------------------------

SILENCE, CTRL_C = 14, 16  # clauses
CLAUSE_OF_END = {  # for ends that are about one clause, whatever came before
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
    """Require the right exit, in time and with the right line; yield the clause and the situation of each."""
    ends, _ = _require_ending(life)
    if any(end.name == "silence" for end in ends):
        _require_cancels(life)
    for end in ends:
        yield _which(life, end)


def _which(life: GuardLife, end: End) -> tuple[int, str]:
    """Return the clause about an end, and the situation."""
    why = next((cause.name for cause in life.reasons() if cause.since < end.at), "")
    if why == "Ctrl-C" and end.name != "silence":
        return CTRL_C, f"{end.name} after Ctrl-C"
    if end.name in CLAUSE_OF_END:
        return CLAUSE_OF_END[end.name], end.because
    if not why:
        return 12, end.name
    return (9 if end.name == "CANCELED" else 11), f"{end.name} after the battery got low"


def _require_ending(life: GuardLife) -> tuple[list[End], ev.NodeExited]:
    """Require a right exit; with status 0 or 4 also the line on stdout that says how the goal ended."""
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
        help="Before the program exits, print a line that says why there was no goal, or why its result is missing.",
        at=exited.t,
    )
    return right, exited


_ends = partial(_obligation, ends_as_it_went)
gives_up_without_a_percentage = _ends("Without a valid percentage within 5 s it exits with status 1", 1)
gives_up_on_a_missing_server = _ends("Without a server within 5 s it exits with status 1", 2)
says_that_the_battery_is_low = _ends("If the battery is low before the goal, it exits with status 4", 3)
waits_for_canceled_and_standing = _ends(
    "After a cancel it waits for CANCELED and STANDING, then exits with status 4", 9
)
waits_5_s_for_each = _ends("It waits at most 5 s for CANCELED, and at most 5 s for STANDING", 10, CTRL_C)
believes_the_end = _ends("After a cancel request the goal's result decides the exit status", 11, CTRL_C)
ends_with_the_goal = _ends("It exits with status 0 after SUCCEEDED, 3 after ABORTED, 4 after CANCELED", 12)
ends_in_silence = _ends("After 5 s without a response, feedback or result it exits with status 1", SILENCE)
ends_after_ctrl_c = _ends("After Ctrl-C it waits for the goal's result, at most 5 s", CTRL_C)


@obligation(13, 15, of=guards, see="06_walk_to_a_pose#hopeful-why")
def says_why(life: GuardLife) -> str | None:
    """With status 1, 2 or 3, one line on stderr says why; after ABORTED only that line contains error_msg"""
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
    """Every clause holds, whatever battery, server and robot do, and whenever Ctrl-C is pressed"""
    for each in EVERYTHING:
        each.require(life)
    ends, _ = _require_ending(life)
    return _which(life, ends[0])[1]
