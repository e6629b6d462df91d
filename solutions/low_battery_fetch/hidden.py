"""What only the instructor's grading checks."""

from __future__ import annotations

import math
import random
from collections.abc import Callable

from autograder.authoring import events as ev
from autograder.authoring import standard_hidden
from autograder.authoring.checks import Scenario, check, expect
from autograder.authoring.goal import ABORTED, CANCELED, SUCCEEDED
from autograder.authoring.missing import unseen
from autograder.authoring.transcript import Transcript

from .checks import (
    BATTERY_LESSON,
    GIVES_UP,
    GOES_DOWN,
    ORPHANS,
    SILENCE_LESSON,
    cancel_goes_down,
    cancels_a_silent_child,
    does_not_set_out_on_a_low_battery,
    fetches,
    finishes_placing_first,
    gives_up_before_the_grasp,
    says_why_a_child_failed,
)
from .child_endings import (
    last_heard,
    require_child_canceled,
    require_finished,
    require_in_order,
    require_no_more,
    require_not_canceled,
    require_nothing_left,
)
from .children import BATTERY, all_children, children, require_child
from .fetch_endings import (
    SILENCE,
    require_abort,
    require_canceled,
    require_failed_child,
    require_patience,
    require_soon,
    require_steps,
    require_success,
)
from .low_battery import (
    require_at_work,
    require_drop,
    require_gave_up_before_the_grasp,
    require_home_after,
    require_stage,
)

GIVING_UP = SILENCE + 3.0  # s


def _any_cup(generator: random.Random) -> dict:
    place = [round(generator.uniform(0.2, 0.6), 2), round(generator.uniform(-0.4, 0.4), 2), 0.7]
    name = generator.choice(["mug", "glass", "bottle"])
    return {"object_id": name, "place": place, "force": round(generator.uniform(5.0, 15.0), 1)}


def _any_drop(generator: random.Random) -> float:
    return round(generator.uniform(0.02, 0.19), 3)


def _at(moment: str) -> Callable[[random.Random], dict]:
    return lambda generator: {"moment": moment, "level": _any_drop(generator)}


ANYTHING = Scenario(
    "good",
    lambda generator: {"goal": _any_cup(generator), "levels": [math.nan, 0.5, 20.0, 0.2, -0.3, 0.2001]},
    robot=None,
)
LONG_WALK = Scenario(
    "good", lambda generator: {"goal": _any_cup(generator), "levels": [], "walk": 8.0}, robot=None
)
OTHER_NAMESPACE = Scenario(
    "good",
    lambda generator: {"goal": _any_cup(generator), "levels": [0.5]},
    robot=None,
    namespace="/lab_7/robot",
)
NO_BATTERY = Scenario("low_before", {"level": None, "then": 0.9}, robot=None)
LOW_THEN_CHARGED = Scenario(
    "low_before", lambda generator: {"level": _any_drop(generator), "then": 0.9}, robot=None
)
APPROACHING = Scenario("drop", _at("approaching the cup"), robot=None)
GRASPING = Scenario("drop", _at("grasping the cup"), robot=None)
AT_THE_TRAY = Scenario("drop", _at("approaching the tray"), robot=None)
PLACING = Scenario("drop", _at("placing the cup"), robot=None)
GOING_HOME = Scenario("drop", _at("going home"), robot=None)
PUTTING_DOWN = Scenario("drop", _at("putting it down"), robot=None)
REFUSES_TO_STOP = Scenario("drop", {"moment": "to the table", "level": 0.1, "agreed": False}, robot=None)
RECOVERS = Scenario(
    "drop", {"moment": "to the table", "level": 0.18, "canceled_after": 2.0, "then": 0.35}, robot=None
)
DROP_BEFORE_ACCEPTANCE = Scenario(
    "drop_before_acceptance", lambda generator: {"level": _any_drop(generator)}, robot=None
)
CANCEL_GRASP = Scenario("cancel", {"moment": "lifting the cup", "canceled_after": 1.5}, robot=None)
CANCEL_LAST = Scenario("cancel", {"moment": "putting it down", "canceled_after": 1.0}, robot=None)
CANCEL_REFUSED = Scenario("cancel", {"moment": "to the table", "agreed": False}, robot=None)
CANCEL_BEFORE_ACCEPTANCE = Scenario("cancel_before_acceptance", robot=None)
UNANSWERED = Scenario("fail", {"step": 1, "how": "unanswered"}, robot=None)
TOO_LATE = Scenario("fail", {"step": 1, "how": "answered too late"}, robot=None)
DIES = Scenario("fail", {"step": 1, "how": "dies"}, robot=None)
ARM_DIES = Scenario("fail", {"step": 2, "how": "dies"}, robot=None)
DEAF = Scenario("fail", {"step": 2, "how": "silent and deaf"}, robot=None)
NOBODY_WALKS = Scenario("without_server", {"missing": "navigate_to_pose"}, robot=None)
NOBODY_GRASPS = Scenario("without_server", {"missing": "pick_and_place"}, robot=None)
BY_ANOTHER = Scenario("fail", {"step": 3, "how": "canceled by another"}, robot=None)
TRIES_AGAIN = Scenario("fail", {"step": 1, "how": "rejected", "again": True}, robot=None)
PREEMPTED_WALK = Scenario(
    "preempt",
    lambda generator: {"moment": "to the table", "canceled_after": 1.5, "goal": _any_cup(generator)},
    robot=None,
)


@check(points=1, on=[ANYTHING, LONG_WALK], needs=fetches, see=BATTERY_LESSON, clauses=[3, 4, 11, 23])
def fetches_anything(anything: Transcript, long_walk: Transcript) -> None:
    """NaN, 20.0 and -0.3 are no percentages, 0.20 is not low, and a child that reports may take longer than 5 s"""
    if len(anything.published(BATTERY)) < 5:
        raise unseen(anything, "the battery's levels were not published")
    for run in (anything, long_walk):
        goal = run.goal("fetch")
        require_steps(goal)
        require_success(goal)


@check(
    points=1,
    on=NO_BATTERY,
    needs=[fetches, does_not_set_out_on_a_low_battery],
    see=BATTERY_LESSON,
    clauses=[10, 17, 30],
)
def sends_nobody_without_a_battery(run: Transcript) -> None:
    """As long as battery_state has said nothing it fetches nothing, and says so; then it does"""
    goal = run.goal("low battery")
    if any(event.t < goal.sent.t for event in run.published(BATTERY)):
        raise unseen(run, "the battery had been published")
    goal.require_accepted("Accept it and abort it at once: a rejection carries no reason.")
    require_no_more(goal, 0, "nothing is known of the battery")
    require_abort(goal, "battery", because="nothing is known of it")
    require_success(run.goal("charged"))


@check(
    points=1,
    on=LOW_THEN_CHARGED,
    needs=[fetches, does_not_set_out_on_a_low_battery],
    see=BATTERY_LESSON,
    clauses=[30],
)
def sets_out_when_it_is_charged(run: Transcript) -> None:
    """A battery that was low and is charged again is no obstacle to the next goal"""
    low, charged = run.goal("low battery"), run.goal("charged")
    require_no_more(low, 0, "the battery is low")
    require_abort(low, "battery", because="it is low")
    require_success(charged)


@check(
    points=2, on=[APPROACHING, GRASPING], needs=gives_up_before_the_grasp, see=GIVES_UP, clauses=[11, 12, 17]
)
def gives_up_while_the_hand_is_empty(approaching: Transcript, grasping: Transcript) -> None:
    """While the stage is approaching or grasping, a drop cancels pick_and_place, too"""
    for run, stage in ((approaching, "approaching"), (grasping, "grasping")):
        goal = run.goal("fetch")
        require_stage(run, require_child(goal, 2), require_drop(run).t, stage)
        require_gave_up_before_the_grasp(goal, 2)


@check(
    points=1, on=AT_THE_TRAY, needs=[fetches, gives_up_before_the_grasp], see=GIVES_UP, clauses=[11, 12, 17]
)
def gives_up_at_home(run: Transcript) -> None:
    """When the battery drops before the grasp at home, it cancels the child and is ABORTED: it is home already"""
    goal = run.goal("fetch")
    require_stage(run, require_child(goal, 4), require_drop(run).t, "approaching")
    require_gave_up_before_the_grasp(goal, 4)


@check(points=1, on=PLACING, needs=finishes_placing_first, see=GIVES_UP, clauses=[13, 17])
def finishes_placing_to_the_end(run: Transcript) -> None:
    """Also while the stage is placing, pick_and_place comes to its own end before the robot goes home"""
    goal = run.goal("fetch")
    child = require_child(goal, 2)
    drop = require_drop(run)
    require_stage(run, child, drop.t, "placing")
    require_not_canceled(
        child,
        "the hand is not empty yet",
        "Every stage after grasping comes to its own end: lifting to retreating.",
    )
    require_finished(goal, child, SUCCEEDED)
    require_home_after(goal, 2, "the battery is low")
    require_in_order(goal)
    require_abort(goal, "battery", because="it dropped while the object was placed")


@check(
    points=1, on=GOING_HOME, needs=[fetches, gives_up_before_the_grasp], see=GIVES_UP, clauses=[14, 15, 17]
)
def carries_it_home(run: Transcript) -> None:
    """When the battery drops on the way home, the robot goes on home; then ABORTED, with the object on the tray"""
    goal = run.goal("fetch")
    child = require_child(goal, 3)
    drop = require_drop(run)
    require_at_work(run, child, drop.t, "the battery dropped")
    require_not_canceled(child, "it is on its way home", "On the way home a low battery changes nothing.")
    require_finished(goal, child, SUCCEEDED)
    require_no_more(goal, 3, "the battery is low: the object stays on the tray")
    require_abort(goal, "battery", because="it dropped on the way home")
    require_nothing_left(goal)


@check(
    points=1,
    on=PUTTING_DOWN,
    needs=[fetches, finishes_placing_to_the_end],
    see="07_cancel_and_preempt#late-why",
    clauses=[13, 16],
)
def success_wins(run: Transcript) -> None:
    """When the battery drops while the object is put down at home, all is done in the end: SUCCEEDED"""
    goal = run.goal("fetch")
    child = require_child(goal, 4)
    require_stage(run, child, require_drop(run).t, "placing")
    require_not_canceled(child, "the hand holds the object", "Let it come to its own end.")
    require_success(goal)


@check(points=1, on=REFUSES_TO_STOP, needs=gives_up_before_the_grasp, see=ORPHANS, clauses=[12, 17, 29])
def waits_for_a_child_that_goes_on(run: Transcript) -> None:
    """A child that refuses the cancel is waited for all the same; then the robot goes home"""
    goal = run.goal("fetch")
    child = require_child(goal, 1)
    drop = require_drop(run)
    asked = require_child_canceled(goal, child, drop.t, "the battery is low and nothing is held")
    if asked.reply and asked.reply.canceling:
        raise unseen(run, "the walk agreed to be canceled")
    require_finished(goal, child, SUCCEEDED)
    require_in_order(goal)
    require_home_after(goal, 1, "the battery is low")
    require_no_more(goal, 2, "the robot is home")
    require_abort(goal, "battery", because="it is low")


@check(points=1, on=RECOVERS, needs=gives_up_before_the_grasp, see=BATTERY_LESSON, clauses=[12, 15, 17])
def gives_up_for_good(run: Transcript) -> None:
    """A battery that recovers while the child stops changes nothing: it goes home, and is ABORTED"""
    goal = run.goal("fetch")
    child = require_child(goal, 1)
    drop = require_drop(run)
    recovered = [event.t for event in run.published(BATTERY) if event.t > drop.t]
    if not recovered or (child.finished and child.finished.t < recovered[0]):
        raise unseen(run, "the battery did not recover before the walk had ended")
    require_gave_up_before_the_grasp(goal, 1)


@check(
    points=1,
    on=DROP_BEFORE_ACCEPTANCE,
    needs=gives_up_before_the_grasp,
    see="08_navigation#client-intro",
    clauses=[12, 17, 19],
)
def gives_up_right_after_the_acceptance(run: Transcript) -> None:
    """A drop before the child is accepted cancels it right after the acceptance"""
    goal = run.goal("fetch")
    child = require_child(goal, 1)
    drop = require_drop(run)
    if child.reply is None or not child.received.t < drop.t < child.reply.t:
        raise unseen(run, "the battery did not drop before the acceptance")
    require_child_canceled(goal, child, child.reply.t, "the battery had fallen before it was accepted")
    require_in_order(goal)
    require_home_after(goal, 1, "the battery is low")
    require_abort(goal, "battery", because="it is low")
    require_nothing_left(goal)


@check(
    points=2,
    on=[CANCEL_GRASP, CANCEL_LAST],
    needs=[fetches, cancel_goes_down],
    see=GOES_DOWN,
    clauses=[18, 20, 21],
)
def cancel_goes_down_to_the_arm(grasp: Transcript, last: Transcript) -> None:
    """A cancel goes down to pick_and_place, too, which knows itself how to end safely"""
    for run, step in ((grasp, 2), (last, 4)):
        goal = run.goal("fetch")
        child = require_child(goal, step)
        require_at_work(run, child, goal.requests_to_cancel[-1].sent.t, "fetch was canceled")
        require_canceled(goal, child)
        require_no_more(goal, step, "fetch was canceled")


@check(points=2, on=CANCEL_REFUSED, needs=cancel_goes_down, see=ORPHANS, clauses=[20, 21])
def waits_although_the_cancel_is_refused(run: Transcript) -> None:
    """When the child refuses the cancel, fetch is CANCELED only when the child has ended by itself"""
    goal = run.goal("fetch")
    child = require_child(goal, 1)
    require_at_work(run, child, goal.requests_to_cancel[-1].sent.t, "fetch was canceled")
    if any(cancel.reply and cancel.reply.canceling for cancel in child.cancels):
        raise unseen(run, "the walk agreed to be canceled")
    require_canceled(goal, child)
    require_no_more(goal, 1, "fetch was canceled")


@check(
    points=1,
    on=CANCEL_BEFORE_ACCEPTANCE,
    needs=cancel_goes_down,
    see="07_cancel_and_preempt#late-why",
    clauses=[19, 20, 21],
)
def remembers_a_cancel(run: Transcript) -> None:
    """A cancel before the child is accepted goes down right after the acceptance"""
    goal = run.goal("fetch")
    child = require_child(goal, 1)
    if child.reply is None or child.reply.t < goal.requests_to_cancel[-1].sent.t:
        raise unseen(run, "the cancel did not come before the acceptance")
    require_canceled(goal, child)
    require_no_more(goal, 1, "fetch was canceled")


@check(points=1, on=UNANSWERED, needs=says_why_a_child_failed, see=SILENCE_LESSON, clauses=[23, 25])
def gives_up_without_an_answer(run: Transcript) -> None:
    """A child whose goal has no answer after 5 s ends fetch ABORTED naming the action"""
    goal = run.goal("fetch")
    child = require_child(goal, 1)
    if child.reply:
        raise unseen(run, "the goal was answered")
    require_failed_child(goal, 1, because="its goal was not answered")
    require_patience(goal, child, child.received.t, "no answer to its goal")


@check(
    points=2,
    on=TOO_LATE,
    needs=[cancels_a_silent_child, gives_up_without_an_answer],
    see="03b_clients_in_bad_company#late-why",
    clauses=[25, 28],
)
def cancels_a_late_child(run: Transcript) -> None:
    """A child that is accepted after its 5 s are over is canceled at once: nobody waits for it any more"""
    goal = run.goal("fetch")
    child = require_child(goal, 1)
    if child.reply is None or not child.reply.accepted or child.reply.t < child.received.t + SILENCE:
        raise unseen(run, "the goal was not accepted too late")
    require_child_canceled(goal, child, child.reply.t, "it was accepted when fetch had given it up")
    require_no_more(goal, 1, "its goal was not answered in 5 s")
    require_abort(goal, "navigate_to_pose", because="its goal was not answered in 5 s")


@check(
    points=2,
    on=[DIES, ARM_DIES],
    needs=[cancels_a_silent_child, fetches],
    see="11_capstone#dead-why",
    clauses=[23, 25, 27],
)
def survives_a_dying_server(walk: Transcript, arm: Transcript) -> None:
    """When a child's server dies, fetch ends ABORTED naming the action, and the node lives"""
    for run, step in ((walk, 1), (arm, 2)):
        goal = run.goal("fetch")
        child = require_child(goal, step)
        died = run.first(ev.ActionWithdrawn)
        if died is None:
            raise unseen(run, "the server did not die")
        require_failed_child(goal, step, because="its server died")
        require_soon(goal, last_heard(child), "the last that was heard of the child", within=2 * GIVING_UP)


@check(points=1, on=DEAF, needs=[cancels_a_silent_child, fetches], see=SILENCE_LESSON, clauses=[25, 27])
def waits_no_longer_than_it_must(run: Transcript) -> None:
    """A silent child that does not answer the cancel either is given up 5 s later, ABORTED naming the action"""
    goal = run.goal("fetch")
    child = require_child(goal, 2)
    if child.finished:
        raise unseen(run, "pick_and_place ended")
    heard = last_heard(child)
    asked = require_child_canceled(goal, child, heard, "nothing was heard of it for 5 s", within=5.0 + 2.5)
    require_failed_child(goal, 2, because="it was silent for 5 s, and after the cancel")
    require_soon(goal, asked.received.t, "the request to cancel", within=GIVING_UP)


@check(
    points=1,
    on=[NOBODY_WALKS, NOBODY_GRASPS],
    needs=says_why_a_child_failed,
    see=SILENCE_LESSON,
    clauses=[24, 25],
)
def gives_up_without_a_server(walks: Transcript, grasps: Transcript) -> None:
    """When nobody offers an action, fetch is ABORTED naming it, at most 5 s after it needed it"""
    for run in (walks, grasps):
        goal = run.goal("fetch")
        missing = run.params["missing"]
        if any(event.action == missing for event in run.all(ev.ActionOffered)):
            raise unseen(run, f"somebody offered {missing}")
        since = goal.require_accepted().sent.t
        if sent := children(goal):
            since = require_finished(goal, sent[0], SUCCEEDED).t
        require_no_more(goal, 1 if missing == "pick_and_place" else 0, f"nobody offers {missing}")
        require_abort(goal, missing, because="nobody offers it")
        require_soon(goal, since, f"looking for {missing}", within=GIVING_UP)


@check(points=1, on=BY_ANOTHER, needs=says_why_a_child_failed, see=ORPHANS, clauses=[22, 25])
def fails_when_another_cancels_the_child(run: Transcript) -> None:
    """A child that somebody else cancels has failed: ABORTED, not CANCELED"""
    goal = run.goal("fetch")
    child = require_child(goal, 3)
    require_finished(goal, child, CANCELED)
    require_failed_child(goal, 3, because="somebody else canceled it")


@check(points=1, on=TRIES_AGAIN, needs=[fetches, says_why_a_child_failed], see=ORPHANS, clauses=[30])
def serves_the_next_goal(run: Transcript) -> None:
    """After a failure the next goal is fetched"""
    require_failed_child(run.goal("fetch"), 1, because="it rejected its goal")
    require_success(run.goal("again"))


@check(
    points=2, on=PREEMPTED_WALK, needs=[cancel_goes_down, fetches], see="11_capstone#newest-why", clauses=[9]
)
def new_goal_preempts_the_old(run: Transcript) -> None:
    """A new goal preempts the old one: its child is canceled and ends, then the old is ABORTED and the new begins"""
    old, new = run.goal("old"), run.goal("new")
    child = require_child(old, 1)
    require_at_work(run, child, new.sent.t, "the new goal came")
    new.require_accepted()
    require_child_canceled(old, child, new.sent.t, "a new goal came")
    old.require_result(ABORTED)
    old.expect(
        "error_code",
        6,
        because="a new goal took the robot",
        help="PickAndPlace.Result.PREEMPTED, with abort(): ROS has no status PREEMPTED.",
    )
    require_nothing_left(old)
    second = all_children(run)[1:]
    if second:
        expect(
            child.finished is not None and second[0].received.t >= child.finished.t,
            expected="the new goal's first child after the end of the old goal's child",
            observed=f"it was sent while {child.received.action} was still at work",
            help="One fetch at a time: the new one waits for the old one's end before it sends anything.",
            at=second[0].received.t,
        )
    require_success(new)


works_in_any_namespace = standard_hidden.works_in_any_namespace(
    "fetches",
    lambda run: require_success(run.goal("fetch")),
    points=1,
    on=OTHER_NAMESPACE,
    needs=fetches,
    clauses=[31],
)
