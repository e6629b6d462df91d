"""What only the instructor's grading checks."""

from __future__ import annotations

import math
import random

from action_msgs.srv import CancelGoal

from autograder.authoring import events as ev
from autograder.authoring.action_client_checks import (
    how_to_give_up,
    require_cancel,
    require_goal_answered,
    require_goal_finished,
    require_one_goal,
    require_refused_cancel,
)
from autograder.authoring.checks import check, expect, program
from autograder.authoring.missing import unseen
from autograder.authoring.transcript import Transcript
from autograder.authoring.walking.client import (
    NO_SERVER,
    PATIENCE,
    STATUS_HELP,
    require_ending_line,
    require_failure,
)

from .checks import (
    AT_ONCE,
    LOOKS_AWAY,
    cancels_when_the_battery_drops,
    ctrl_c_cancels_the_goal,
    does_not_set_out_on_a_low_battery,
    does_not_set_out_without_a_battery_state,
    gives_up_without_a_server,
    ignores_what_is_no_percentage,
    says_how_it_failed,
    says_how_it_succeeded,
    waits_until_the_robot_stands,
)
from .judging import (
    BATTERY,
    GIVING_UP,
    NAVIGATE,
    WITHIN,
    GoalStatus,
    require_canceled,
    require_drop,
    require_end_after,
    require_goal_at,
    require_level,
    require_no_goal,
    require_one_cancel,
    require_patience,
    require_success,
    require_undisturbed_success,
    standing_at,
)


def _any_pose(generator: random.Random, arguments: int = 3) -> dict:
    """A pose with a negative x, and a battery that runs down without getting low."""
    pose = [-round(generator.uniform(0.3, 3.0), 2), round(generator.uniform(0.3, 3.0), 2)]
    pose += [round(generator.uniform(-3.0, 3.0), 2)]
    levels = sorted((round(generator.uniform(0.21, 1.0), 2) for _ in range(4)), reverse=True)
    return {"arguments": [str(value) for value in pose[:arguments]], "levels": [1.0, *levels]}


def _any_drop(generator: random.Random) -> float:
    return round(generator.uniform(0.02, 0.19), 3)


ANY_POSE = program("good", _any_pose, namespace="/lab_7/robot")
WITHOUT_YAW = program("good", lambda generator: _any_pose(generator, arguments=2))
AT_THE_LIMIT = program("level_before", {"level": 0.20})
DOWN_TO_THE_LIMIT = program("good", {"arguments": ["1.5", "-0.5", "0.4"], "levels": [0.23, 0.2, 0.2001]})
JUST_BELOW = program("dropping", {"levels": [0.2, 0.1999], "ends_after": 0.4, "stands_after": 0.9})
EMPTY = program("dropping", {"levels": [0.5, 0.0], "ends_after": 0.4, "stands_after": 0.9})
BEFORE_ACCEPTANCE = program("dropping_before_acceptance", lambda generator: {"level": _any_drop(generator)})
IN_VAIN = program(
    "dropping_at_the_end",
    lambda generator: {"level": _any_drop(generator), "ends_after": 3.5, "result_after": 0.0},
)
TOO_LATE = program(
    "dropping_at_the_end",
    lambda generator: {"level": _any_drop(generator), "ends_after": 1.0, "result_after": 2.5},
)
REFUSED = program(
    "dropping_at_the_end",
    lambda generator: {
        "level": _any_drop(generator),
        "ends_after": 4.0,
        "result_after": 0.0,
        "agreed": False,
    },
)
LATE_SERVER = program("late_server", lambda generator: {"level": _any_drop(generator)})
NEVER_A_PERCENTAGE = program("no_percentage_first", {"levels": [20.0, math.nan], "then": None})
A_PERCENTAGE_AT_LAST = program("no_percentage_first", {"levels": [math.nan, 20.0], "then": 0.64})
STANDS_FIRST = program("dropping", {"levels": [0.1], "ends_after": 2.5, "stands_after": 0.5})
ON_THE_SPOT = program("dropping_on_the_spot", lambda generator: {"level": _any_drop(generator)})
DEAF = program("dropping", {"levels": [0.1], "ends_after": None, "stands_after": 0.5, "agreed": None})
NEVER_STANDS = program("dropping", {"levels": [0.1], "ends_after": 0.5, "stands_after": None})
UNANSWERED = program("unanswered")
SILENT = program("silent")
BY_ANOTHER = program("canceled_by_another")


@check(
    points=1,
    on=[ANY_POSE, WITHOUT_YAW],
    needs=says_how_it_succeeded,
    see="01_robot_and_graph#names-why",
    clauses=[4, 5, 18],
)
def goes_anywhere(with_yaw: Transcript, without_yaw: Transcript) -> None:
    """Negative numbers, a yaw that is left out, a battery at 1.0 and another namespace are no obstacle"""
    for run in (with_yaw, without_yaw):
        x, y, *yaw = map(float, run.params["arguments"])
        require_level(run, low=False)
        require_goal_at(run, x, y, yaw[0] if yaw else 0.0)
        require_undisturbed_success(run)


@check(
    points=2,
    on=[AT_THE_LIMIT, DOWN_TO_THE_LIMIT, JUST_BELOW, EMPTY],
    needs=cancels_when_the_battery_drops,
    see="08_navigation#float-why",
    clauses=[7],
)
def compares_with_the_limit_exactly(
    at_the_limit: Transcript, down_to_it: Transcript, just_below: Transcript, empty: Transcript
) -> None:
    """0.20 as a float32 is not below 0.20; 0.1999 and 0.0 are"""
    for run in (at_the_limit, down_to_it):
        require_level(run, low=False)
        if not run.scripted_goals(NAVIGATE):
            exited = run.first(ev.NodeExited)
            expect(
                exited is None,
                expected="a goal: the percentage is 0.20, which is not below 0.20",
                observed="the program ended without one",
                help="Compare percentage < 0.20, without rounding: as a float32, 0.20 is 0.200000003.",
                at=run.end,
            )
        require_undisturbed_success(run)
    for run in (just_below, empty):
        require_one_goal(run, NAVIGATE)
        drop = require_drop(run)
        level = drop.message.percentage
        require_one_cancel(
            run,
            drop.t,
            AT_ONCE,
            because=f"the battery fell to {level:.4f}",
            help="0.0 is a percentage, an empty battery: only NaN says that nothing is known."
            if level == 0.0
            else "Compare the number as it comes, percentage < 0.20, without rounding it to whole percents.",
        )


@check(
    points=1,
    on=BEFORE_ACCEPTANCE,
    needs=cancels_when_the_battery_drops,
    see="08_navigation#client-intro",
    clauses=[6],
)
def cancels_right_after_the_acceptance(run: Transcript) -> None:
    """A battery that drops before the goal is accepted cancels it right after the acceptance"""
    goal = require_one_goal(run, NAVIGATE)
    drop = require_drop(run)
    accepted = require_goal_answered(run, goal, accepted=True)
    if not goal.received.t < drop.t < accepted:
        raise unseen(run, "the battery did not drop between the goal and its acceptance")
    require_one_cancel(
        run,
        accepted,
        AT_ONCE,
        because=f"the battery had fallen {accepted - drop.t:.1f} s before the goal was accepted",
        help="Without a goal handle nothing can be cancelled, so remember that the battery is low, and look at it "
        "when you have the handle. No new message need come.",
    )


@check(
    points=2,
    on=[IN_VAIN, TOO_LATE],
    needs=cancels_when_the_battery_drops,
    see="07_cancel_and_preempt#late-why",
    clauses=[11, 12],
)
def success_wins_the_race(in_vain: Transcript, too_late: Transcript) -> None:
    """A goal that SUCCEEDED in spite of the cancel ends it with status 0"""
    for run in (in_vain, too_late):
        goal = require_one_goal(run, NAVIGATE)
        require_goal_answered(run, goal, accepted=True)
        drop = require_drop(run)
        finished = require_goal_finished(run, goal, GoalStatus.STATUS_SUCCEEDED)
        if run is in_vain and not drop.t < finished.t:
            raise unseen(run, "the battery did not drop before the end of the goal")
        if run is too_late and goal.result_sent and goal.result_sent.t < drop.t:
            raise unseen(run, "the result came before the battery dropped")
        _require_success_in_spite_of_a_cancel(run, finished.t)


def _require_success_in_spite_of_a_cancel(run: Transcript, finished: float) -> None:
    exited = run.first(ev.NodeExited)
    expect(
        exited is None or exited.returncode != 4,
        expected="exit status 0: the goal SUCCEEDED, although a cancel had been sent",
        observed="exit status 4",
        help="A cancel is a request. How the goal ended, only response.status says: look at it after the cancel, too.",
        at=run.end,
    )
    require_success(run, finished + WITHIN)


@check(
    points=1,
    on=LATE_SERVER,
    needs=does_not_set_out_on_a_low_battery,
    see="08_navigation#guard-intro",
    clauses=[3],
)
def looks_at_the_battery_until_it_sends(run: Transcript) -> None:
    """A battery that drops while it waits for the server keeps it from sending the goal"""
    drop = require_drop(run)
    offered = run.first(ev.ActionOffered)
    if offered and offered.t < drop.t:
        raise unseen(run, "the server was there before the battery dropped")
    require_no_goal(
        run,
        f"the battery fell to {drop.message.percentage:.2f} before the server appeared",
        "wait_for_server() does not spin, so no message reaches you meanwhile: look at server_is_ready() between "
        "spins, and at the last percentage just before you send.",
    )
    require_canceled(run, drop.t + WITHIN, "the battery is low")


@check(
    points=1,
    on=[NEVER_A_PERCENTAGE, A_PERCENTAGE_AT_LAST],
    needs=[ignores_what_is_no_percentage, does_not_set_out_without_a_battery_state],
    see="08_navigation#guard-traps-why",
    clauses=[1, 8],
)
def waits_for_a_percentage(never: Transcript, at_last: Transcript) -> None:
    """While battery_state holds no percentage it waits, at most 5 s, and then ends with status 1"""
    if not never.published(BATTERY):
        raise unseen(never, f"{BATTERY} was not published")
    help = "A message that you ignore counts as none: wait on for a percentage from 0 to 1, at most 5 s."
    require_no_goal(never, "battery_state said 20.0 and NaN, and nothing else", help)
    require_failure(
        never, GIVING_UP, NO_SERVER, because="battery_state said 20.0 and NaN, and nothing else", help=help
    )
    ready = never.first(ev.NodeReady)
    if ready is None:
        raise unseen(never, "the program's node never appeared")
    require_patience(never, ready.t, what="a battery_state without a percentage", help=help)
    goals = at_last.scripted_goals(NAVIGATE)
    first = next((event for event in at_last.published(BATTERY) if 0 <= event.message.percentage <= 1), None)
    if first is None:
        raise unseen(at_last, "no percentage was published")
    if goals:
        expect(
            goals[0].received.t >= first.t,
            expected="no goal before the first percentage from 0 to 1",
            observed=f"a goal {first.t - goals[0].received.t:.1f} s before",
            help=help,
            at=goals[0].received.t,
        )
    require_undisturbed_success(at_last)


@check(
    points=1,
    on=[STANDS_FIRST, ON_THE_SPOT],
    needs=waits_until_the_robot_stands,
    see="08_navigation#standing-why",
    clauses=[9],
)
def takes_standing_and_canceled_in_any_order(stands_first: Transcript, on_the_spot: Transcript) -> None:
    """When the robot stands before the goal is CANCELED, or has not moved yet, CANCELED ends it"""
    for run in (stands_first, on_the_spot):
        goal = require_one_goal(run, NAVIGATE)
        drop = require_drop(run)
        require_one_cancel(run, drop.t, AT_ONCE, because="the battery is low", help=LOOKS_AWAY)
        finished = require_goal_finished(run, goal, GoalStatus.STATUS_CANCELED)
        standing = standing_at(run)
        if standing is None or standing > finished.t:
            raise unseen(run, "the robot did not stand when the goal was CANCELED")
        require_canceled(run, finished.t + WITHIN, "the battery was low and the goal was CANCELED")
        require_end_after(
            run,
            finished.t,
            AT_ONCE,
            what="CANCELED, as the robot stood already",
            help="Wait for the result of the goal, too.",
        )


@check(
    points=1,
    on=[DEAF, NEVER_STANDS],
    needs=waits_until_the_robot_stands,
    see="08_navigation#standing-why",
    clauses=[10],
)
def waits_no_longer_than_5_s(deaf: Transcript, never_stands: Transcript) -> None:
    """If CANCELED or STANDING does not come within 5 s, it ends all the same, with status 4"""
    goal = require_one_goal(deaf, NAVIGATE)
    asked = require_one_cancel(
        deaf, require_drop(deaf).t, AT_ONCE, because="the battery is low", help=LOOKS_AWAY
    )
    if goal.finished:
        raise unseen(deaf, "the goal ended")
    _require_end_in_any_case(deaf, asked.received.t, "CANCELED")
    goal = require_one_goal(never_stands, NAVIGATE)
    require_drop(never_stands)
    finished = require_goal_finished(never_stands, goal, GoalStatus.STATUS_CANCELED)
    if (standing_at(never_stands) or 0.0) > goal.received.t:
        raise unseen(never_stands, "the robot stood")
    _require_end_in_any_case(never_stands, finished.t, "STANDING")


def _require_end_in_any_case(run: Transcript, since: float, what: str) -> None:
    ended = run.first(ev.NodeExited)
    require_canceled(run, since + GIVING_UP + PATIENCE, "the battery was low")
    require_patience(run, since, what=f"{what} after the cancel", help=f"Wait up to 5 s for {what}.")
    if ended:
        expect(
            ended.t - since <= GIVING_UP,
            expected=f"the end {PATIENCE:g} s after the wait for {what} began",
            observed=f"{ended.t - since:.1f} s after it",
            help="Give each wait after the cancel a limit of 5 s, counted from its beginning: feedback may go on.",
            at=ended.t,
        )


@check(
    points=1,
    on=[UNANSWERED, SILENT],
    needs=gives_up_without_a_server,
    see="03_clients_that_survive#fix-why",
    clauses=[14, 15],
)
def gives_up_in_silence(unanswered: Transcript, silent: Transcript) -> None:
    """5 s without an answer, or without feedback and result, end it with status 1; an accepted goal is canceled"""
    goal = require_one_goal(unanswered, NAVIGATE)
    if goal.reply:
        raise unseen(unanswered, "the goal was answered")
    require_failure(
        unanswered,
        GIVING_UP + PATIENCE,
        NO_SERVER,
        because="the goal was never answered",
        help="Wait for the answer at most 5 s: look at future.done() between spins.",
    )
    goal = require_one_goal(silent, NAVIGATE)
    accepted = require_goal_answered(silent, goal, accepted=True)
    if goal.finished and not goal.cancels:
        raise unseen(silent, "the goal ended by itself")
    require_one_cancel(
        silent,
        accepted + PATIENCE - 0.5,
        0.5,
        because="nothing was heard of the goal for 5 s",
        help=how_to_give_up(silent),
    )
    require_failure(
        silent, accepted + GIVING_UP + PATIENCE, NO_SERVER, because="the server is silent", help=STATUS_HELP
    )


@check(
    points=1,
    on=BY_ANOTHER,
    needs=[says_how_it_failed, ctrl_c_cancels_the_goal],
    see="08_navigation#stop-why",
    clauses=[12],
)
def tells_a_cancel_by_another(run: Transcript) -> None:
    """A goal that somebody else cancels ends it with status 4, and a line on stdout says CANCELED"""
    require_goal_finished(run, require_one_goal(run, NAVIGATE), GoalStatus.STATUS_CANCELED)
    exited = require_canceled(run, WITHIN, "the goal was CANCELED")
    require_ending_line(run, "CANCELED", exited.t)


@check(
    points=1, on=REFUSED, needs=success_wins_the_race, see="07_cancel_and_preempt#m1-why", clauses=[11, 12]
)
def a_refused_cancel_is_no_end(run: Transcript) -> None:
    """When the cancel is refused (empty goals_canceling), the goal is followed: SUCCEEDED ends it with status 0"""
    goal = require_one_goal(run, NAVIGATE)
    require_drop(run)
    require_cancel(run, goal, because="the battery is low", help=LOOKS_AWAY)
    require_refused_cancel(goal, run, CancelGoal.Response.ERROR_NONE)
    finished = require_goal_finished(run, goal, GoalStatus.STATUS_SUCCEEDED)
    _require_success_in_spite_of_a_cancel(run, finished.t)
