"""What must hold for every goal of fetch and every goal that it sends, whatever its children and the battery do."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import Any

from autograder.authoring import (
    SUCCEEDED,
    Failure,
    Goal,
    Obligation,
    Transcript,
    differing_fields,
    expect,
    goals,
    obligation,
    require_alive,
    shown,
    whole_run,
)

from . import turns
from .fetching import BATTERY, NAVIGATE, PICK, SILENCE, SLACK, Child, Fetch, children, fetches, objection
from .turns import Turn, require_turn

CANCEL_TIME = 1.0 + SLACK  # s from a reason to the cancel request for the child
REORDER_TIME = 0.2  # s; feedback and battery messages within this time may arrive in either order
IN_TRANSIT_TIME = 0.5  # s before the result of fetch; feedback sent in it may arrive after the result
Sent = tuple[Fetch, Child]

# -- goals -----------------------------------------------------------------------------------------------------------


@obligation(8, of=goals, see="07_cancel_and_preempt#conventions")
def rejects_the_impossible(goal: Goal) -> str | None:
    """It rejects a place_pose that is not in odom or not finite, and a grasp_force that is not finite and above 0"""
    because = objection(goal.request)
    if not because:
        return None
    goal.require_rejected(
        because=because,
        help="Test frame_id, then every number with math.isfinite(), and grasp_force > 0, in goal_callback.",
    )
    return because.split(" is ")[0]


@obligation(18, of=fetches, see="11_capstone#careful-why")
def grants_cancels(fetch: Fetch) -> str | None:
    """A cancel is accepted at any moment while fetch is active"""
    end = fetch.goal.result.t if fetch.goal.result else math.inf
    asked = [each for each in fetch.goal.cancels if each.sent.t < end]
    for each in asked:
        if each.sent.t < end - SLACK or each.answer is None:
            each.require_agreed(fetch.goal)
    at_work = [child for child in fetch.children if asked and child.t < asked[0].sent.t]
    return at_work[-1].step if at_work else None


# -- the next step ---------------------------------------------------------------------------------------------------


def _follows(why: str, sentence: str, *clauses: int) -> Obligation:
    """Make the obligation that a fetch takes the right next step for this reason."""
    return Obligation(why, sentence, clauses, turns.turns(why), turns.require_turn)


sets_out = _follows(turns.BEGINS, "It accepts a goal, and sends the robot to the table", 1)
takes_it = _follows(
    turns.AT_TABLE, "At the table it sends pick_and_place the goal to put the object onto the tray", 1, 2, 4
)
walks_home = _follows(turns.ON_TRAY, "When the object is on the tray, it sends the robot home", 1)
puts_it_down = _follows(
    turns.AT_HOME, "At home it sends pick_and_place the goal to put the object down at place_pose", 1, 3, 4
)
ends_well = _follows(turns.DONE, "When the object is put down, fetch SUCCEEDS, also on a low battery", 5, 16)
does_nothing_when_low = _follows(
    turns.LOW_BEFORE,
    "If the battery is low at first, fetch sends no goal and is ABORTED naming the battery",
    10,
    17,
)
does_nothing_when_unknown = _follows(
    turns.UNKNOWN, "If the battery is unknown, fetch sends no goal and is ABORTED naming the battery", 10, 17
)
goes_home_when_low = _follows(
    turns.LOW_AWAY, "If the battery gets low, the robot goes home when the child has ended", 12, 13, 15
)
gives_up_when_home = _follows(
    turns.LOW_AT_HOME, "If the battery gets low, fetch is ABORTED at home, naming the battery", 12, 14, 15, 17
)
ends_canceled = _follows(
    turns.IS_CANCELED,
    "After a cancel fetch sends no further goal, and is CANCELED when the child has ended",
    20,
    21,
)
ends_preempted = _follows(
    turns.IS_PREEMPTED, "After a newer goal the old one is ABORTED with PREEMPTED when its child has ended", 9
)
says_who_failed = _follows(
    turns.FAILED,
    "If a child fails, fetch is ABORTED at once, naming the action and the child's reason",
    22,
    25,
    26,
)
gives_up_the_unanswered = _follows(
    turns.UNANSWERED, "If a goal has no response for 5 s, fetch is ABORTED naming the action", 23, 25
)
gives_up_the_silent = _follows(
    turns.SILENT,
    "If a child has no feedback for 5 s, fetch is ABORTED when it has ended, or 5 s later",
    23,
    25,
    27,
)
gives_up_the_missing = _follows(
    turns.NO_SERVER, "If a server is missing for 5 s, fetch is ABORTED naming the action", 24, 25
)
goes_on_as_it_must = Obligation(
    "goes_on_as_it_must",
    "At its start and whenever a child has ended, fetch takes the step that the clauses require",
    (1, 5, 9, 10, 12, 20, 22),
    turns.turns(),
    turns.require_turn,
)


def _after_a_failure(run: Transcript) -> list[Turn]:
    done = turns.turns(turns.DONE)(run)
    failed = [each for each in fetches(run) if each.goal.result and each.goal.status != SUCCEEDED]
    return [turn for turn in done if any(each.goal.sent.t < turn.fetch.goal.sent.t for each in failed)]


@obligation(30, of=_after_a_failure, see="08_navigation#guard-traps-why")
def serves_again(turn: Turn) -> str:
    """After a goal that did not succeed, the next one can succeed"""
    return require_turn(turn)


# -- the children ----------------------------------------------------------------------------------------------------


@obligation(29, of=whole_run)
def one_child_at_a_time(run: Transcript) -> str | None:
    """At most one child is active at any time, and none when fetch has ended"""
    sent = [child for _, child in children(run)]
    for before, after in pairwise(sent):
        turns.require_over(before, after)
    for fetch, child in children(run):
        if result := fetch.goal.result:
            expect(
                child.t <= result.t,
                expected="no more goals to children after fetch has ended",
                observed=f"a goal to {child.action}",
                help="Call succeed(), abort() or canceled() only when no goal is left to send, then return.",
                at=child.t,
            )
            turns.require_over(child, result)
    return f"{len(sent)} children" if sent else None


@obligation(11, 19, of=children)
def stops_with_empty_hands(sent: Sent) -> str | None:
    """While the hand is empty, a low battery cancels the child within 1 s, or right after its acceptance"""
    fetch, child = sent
    low, began = fetch.low_at, child.began
    if low is None or began is None or fetch.stopped_at < low:
        return None
    level = fetch.level(low)
    expect(
        level is not None and level.subscriptions > 0,
        expected=f"a subscription to {BATTERY} while the node runs",
        observed="no subscription",
        help=f'Write create_subscription(BatteryState, "{BATTERY}", …) with a relative name and TRANSIENT_LOCAL.',
        at=low,
    )
    if not child.is_empty_handed(max(low, began)) or not child.is_empty_handed(max(low, began) + CANCEL_TIME):
        return None
    return _passed_on(child, low, "the battery is low and the hand is empty")


@obligation(18, 19, of=children)
def hands_a_cancel_down(sent: Sent) -> str | None:
    """A cancel of fetch cancels the active child within 1 s, or right after its acceptance"""
    return _passed_on(sent[1], sent[0].canceled_at, "fetch was canceled")


@obligation(9, of=children)
def hands_a_preemption_down(sent: Sent) -> str | None:
    """A newer goal cancels the child of the old one"""
    return _passed_on(sent[1], sent[0].preempted_at, "a newer goal came")


def _passed_on(child: Child, came: float | None, because: str) -> str | None:
    """Require that a reason at a time (s) led to a cancel of a child, unless the child had ended by then."""
    if came is None or child.began is None or _is_given_up(child, came):
        return None
    moment = "before it was accepted" if came < child.began else ""
    return _require_canceled(child, max(came, child.began), because, moment)


@obligation(23, 27, of=children)
def cancels_the_silent(sent: Sent) -> str | None:
    """An accepted child without feedback for 5 s is canceled, not much earlier and not much later"""
    child = sent[1]
    silent = child.silent_at
    if silent is None or child.is_dead or child.is_late or child.is_silent_after_a_cancel:
        return None
    because = "no feedback came from it for 5 s"
    return _require_canceled(child, silent - SLACK, because, "", within=SLACK + turns.AT_ONCE_TIME)


@obligation(28, of=children)
def cancels_the_late(sent: Sent) -> str | None:
    """A child that is accepted only after more than 5 s is canceled at once"""
    child = sent[1]
    if child.began is None or child.began < child.t + SILENCE + SLACK:
        return None
    return _require_canceled(child, child.began, "it was accepted when fetch no longer waited for it", "")


@obligation(11, 13, 14, 23, of=children)
def cancels_for_a_reason(sent: Sent) -> str | None:
    """It cancels only its own child, and only after a cancel, a newer goal, a low battery, or 5 s without feedback"""
    fetch, child = sent
    given_up = child.began if child.is_late and child.began else math.inf
    for number, each in enumerate(child.cancels()):
        t = each.received.t
        low = fetch.low_at is not None and _is_for_the_battery(child, fetch.low_at, t)
        heard = max((last for last in child.received if last < t), default=child.t)
        expect(
            number > 0 or low or min(fetch.stopped_at, given_up) <= t or t - heard >= SILENCE - SLACK,
            expected=f"{child.action} to end by itself, as fetch was not canceled, no newer goal came, and the "
            "battery was not low before the grasp",
            observed=f"a cancel request {t - heard:.1f} s after its last feedback or acceptance",
            help="Cancel a child only when fetch is canceled or preempted, when the battery is low and the hand is "
            "empty, or when no feedback has come for 5 s.",
            at=t,
        )
        expect(
            each.received.goal == child.sent.name,
            expected="a request to cancel this one goal",
            observed="a request to cancel all goals",
            help="Call cancel_goal_async() of the child's goal handle: other clients may use the robot, too.",
            at=t,
        )
    return child.step


@obligation(13, 14, 15, of=children)
def lets_it_finish(sent: Sent) -> str | None:
    """On a low battery a child is not canceled while the hand holds something or the robot goes home"""
    fetch, child = sent
    low, began = fetch.low_at, child.began
    if low is None or began is None or fetch.stopped_at < math.inf or (child.ended or math.inf) < low:
        return None
    if child.is_empty_handed(max(low, began)):
        return None
    cancels_for_a_reason.require(sent)
    return child.stage(low) or ("gone home" if child.t > low else "on the way home")


def _require_canceled(
    child: Child, since: float, because: str, moment: str, *, within: float = CANCEL_TIME
) -> str | None:
    """Require a cancel request for a child soon after a time (s); return what the child did at that time."""
    asked = [each.received.t for each in child.cancels()]
    if asked and asked[0] <= since + within:
        return moment or child.stage(since) or child.step
    if child.ended is not None and child.ended <= since + within:
        return None  # it ended before
    require_alive(child.run)
    raise Failure(
        expected=f"a request to cancel {child.action} within {within - SLACK:g} s, because {because}",
        observed=f"the request came {asked[0] - since:.1f} s after that" if asked else "no request",
        help="The child had not been accepted yet: store the reason, and cancel as soon as you have the goal handle."
        if moment
        else "Keep the child's goal handle while it is active. Check several times a second whether there is a reason "
        "to cancel, and call its cancel_goal_async().",
        at=since,
    )


def _is_for_the_battery(child: Child, low: float, t: float) -> bool:
    """Return whether the reason for a cancel request at a time (s) may have been the low battery."""
    return low <= t and child.is_empty_handed(max(low - REORDER_TIME, t - CANCEL_TIME))


def _is_given_up(child: Child, t: float) -> bool:
    """Return whether at a time (s) a child had ended, or fetch no longer had to wait for it."""
    over = child.ended is not None and child.ended <= t
    return over or child.is_late or (child.silent_at is not None and child.silent_at - SLACK <= t)


# -- feedback and result ---------------------------------------------------------------------------------------------


@obligation(7, of=children, see="06_walk_to_a_pose#slow-why")
def hands_feedback_on(sent: Sent) -> str | None:
    """All feedback of pick_and_place is published as feedback of fetch, unchanged, in order and within 1 s"""
    fetch, child = sent
    end = min(fetch.goal.result.t if fetch.goal.result else math.inf, child.run.end) - IN_TRANSIT_TIME
    published = [each for each in child.sent.feedback if child.began is not None and each.t < end]
    if child.action == NAVIGATE or not published or fetch.stopped_at < math.inf:
        return None
    come = iter(fetch.goal.feedback)
    for each in published:
        alike = (f for f in come if f.t >= each.t and not differing_fields(f.feedback, each.feedback))
        match = next(alike, None)
        expect(
            match is not None and match.t - each.t <= CANCEL_TIME,
            expected=f"feedback of fetch that equals pick_and_place's feedback with stage "
            f"{shown(each.feedback.stage)}, within 1 s",
            observed="none with equal fields" if match is None else f"{match.t - each.t:.1f} s later",
            help="Give send_goal_async a feedback_callback that calls goal_handle.publish_feedback(message.feedback).",
            at=each.t,
        )
    return child.step


@obligation(6, of=turns.turns(turns.DONE), see="07_cancel_and_preempt#m13-why")
def reports_the_object(turn: Turn) -> str | None:
    """The result has the object's final pose, the larger of both forces, and error_code NONE"""
    goal = turn.fetch.goal
    picks = [each.sent.finished for each in turn.fetch.children if each.action == PICK]
    arm = [each.result for each in picks if each]
    result = goal.require_result(SUCCEEDED)
    help = "Before succeed(), fill your result from response.result of the last pick_and_place."
    differing = differing_fields(result.result.final_object_pose, arm[-1].final_object_pose)
    expect(
        not differing,
        expected="final_object_pose equal to that of the last pick_and_place",
        observed=f"a different {' and '.join(differing)}",
        help=help,
        at=result.t,
    )
    forces = [each.max_grasp_force for each in arm]
    because = f"the two results of pick_and_place have {' and '.join(f'{each:g}' for each in forces)} N"
    goal.expect("max_grasp_force", max(forces), because=because, help=f"Keep the larger force. {help}")
    goal.expect("error_code", 0, because="nothing went wrong", help="NONE is 0, the default.")
    return "the first force is larger" if forces[0] > forces[-1] else "the second force is larger"


def of(names: Sequence[str], *obligations: Obligation) -> list[Obligation]:
    """Return the obligations, restricted to the goals of fetch with these names."""

    def some(each: Obligation) -> Callable[[Transcript], list[Any]]:
        return lambda run: [one for one in each.occasions(run) if _name(one) in names]

    return [replace(each, occasions=some(each)) for each in obligations]


def _name(occasion: Fetch | Turn | Sent) -> str:
    fetch = occasion[0] if isinstance(occasion, tuple) else occasion
    return (fetch.fetch if isinstance(fetch, Turn) else fetch).goal.name


always = (goes_on_as_it_must, cancels_for_a_reason)
stops_in_time = (*always, stops_with_empty_hands, goes_home_when_low, gives_up_when_home)
finishes_first = (*always, lets_it_finish, goes_home_when_low, gives_up_when_home)
obeys_a_cancel = (grants_cancels, *always, hands_a_cancel_down, ends_canceled)
gives_way = (*always, hands_a_preemption_down, ends_preempted)
fetches_it = (sets_out, takes_it, walks_home, puts_it_down, ends_well, one_child_at_a_time)
_every = [
    each for each in globals().values() if isinstance(each, Obligation) and each.require != turns.require_turn
]


@obligation(of=whole_run)
def keeps_every_clause(run: Transcript) -> str:
    """Every clause holds in any situation"""
    return ", ".join(each.name for each in (goes_on_as_it_must, *_every) if each.judge(run))
