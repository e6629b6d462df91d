"""What students can see being checked."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from autograder.authoring import RESTING, Scenario, check_of, standard

from . import model

TABLE = ("--scene", "table")
AFTERWARDS = 1.5  # s after a result in which nothing more may happen
PLACE = [0.35, -0.27]  # x, y m in odom
HERE = [0.33, -0.25]


def at_the_table(*steps: Sequence[Any], **inputs: Any) -> Scenario:
    """Return the scenario of steps with hand and cup watched, and some time more at the end."""
    return Scenario("in_order", {"steps": [*steps, ["wait", AFTERWARDS]], **inputs}, robot=TABLE)


def _resting(*steps: Sequence[Any]) -> Scenario:
    return Scenario("in_order", {"steps": list(steps), "watched": []}, robot=RESTING)


FETCH = at_the_table(["go", "fetch", PLACE], ["arrive", "fetch"])
IMPOSSIBLE = _resting(
    ["go", "wrong frame", HERE, 10.0, "cup", "map"],
    ["go", "no frame", HERE, 10.0, "cup", ""],
    ["go", "NaN place", [math.nan, -0.25]],
    ["go", "infinite place", [0.33, -math.inf]],
    *(["go", f"force {force}", HERE, force] for force in (math.nan, 0.0, -8.0, 40.0)),
    ["wait", AFTERWARDS],
)
UNKNOWN = _resting(["go", "unknown", HERE, 10.0, "teapot"], ["arrive", "unknown"])
FAR_PLACE = at_the_table(["go", "far", [0.75, -0.25]], ["arrive", "far"], watched=["hand", "joints"])
FAR_CUP = at_the_table(
    ["put_cup", 0.57, 0.37], ["go", "far", [0.34, -0.20]], ["arrive", "far"], watched=["hand", "joints"]
)
TAKEN = at_the_table(["go", "fetch", PLACE], ["take_when", "closing"], ["arrive", "fetch"])
SNATCHED = at_the_table(
    *(["put_cup", 0.32, -0.10], ["go", "fetch", [0.34, -0.28]]),
    *(["take_when", "carried", "fetch", 0.0], ["arrive", "fetch"]),
)
CANCEL = at_the_table(
    ["go", "fetch", PLACE], ["wait_until", "near"], ["cancel", "fetch"], ["arrive", "fetch"]
)
HOLDING = at_the_table(
    *(["put_cup", 0.32, -0.10], ["go", "fetch", [0.34, -0.28]]),
    *(["wait_until", "carried", "fetch", 0.0], ["cancel", "fetch"], ["arrive", "fetch"]),
)
TWO = at_the_table(
    *(["go", "first", PLACE], ["wait_until", "lifted"], ["go", "second", [0.34, -0.10]]),
    *(["arrive", "first"], ["arrive", "second"]),
)
BLOCKED = at_the_table(
    *(["go", "fetch", PLACE], ["wait_until", "above the table"], ["hold", "r_elbow"]),
    *(["arrive", "fetch"], ["release", "r_elbow"]),
)
FALL = at_the_table(
    *(["go", "fetch", PLACE], ["wait_until", "near"], ["knock_over", 0.0, 60.0, 0.0], ["end", "fetch"])
)
INTERRUPT = _resting(["interrupt"])

LOOK = "07_cancel_and_preempt#conventions"

server_appears = standard.server_appears(
    "the action pick_and_place", on=INTERRUPT, see="07_cancel_and_preempt#fix-file", clauses=[21]
)
accepts_a_goal = check_of(
    "accepts_a_goal",
    model.accepts,
    title="It accepts a goal with a place in frame odom and a force of 10 N",
    on=FETCH,
    needs=server_appears,
    see="07_cancel_and_preempt#m2-why",
)
places_the_cup = check_of(
    "places_the_cup",
    model.places,
    model.puts_down,
    points=3,
    on=FETCH,
    needs=accepts_a_goal,
    see="09_arms#careful-why",
)
lifts_the_cup = check_of("lifts_the_cup", model.lifts, on=FETCH, needs=places_the_cup, see="09_arms#firm-why")
keeps_the_force = check_of(
    "keeps_the_force", model.keeps_force, points=2, on=FETCH, needs=lifts_the_cup, see="09_arms#force-why"
)
fills_the_result = check_of(
    "fills_the_result",
    model.filled_result,
    on=FETCH,
    needs=places_the_cup,
    see="06_walk_to_a_pose#late-why",
)
feedback_keeps_its_rate = check_of(
    "feedback_keeps_its_rate", model.feedback_at_5_hz, on=FETCH, needs=accepts_a_goal, see=LOOK
)
names_its_stages = check_of(
    "names_its_stages",
    model.names_stages,
    on=FETCH,
    needs=places_the_cup,
    see="09_arms#phases-intro",
)
stages_are_true = check_of(
    "stages_are_true",
    model.true_stages,
    on=FETCH,
    needs=[names_its_stages, lifts_the_cup],
    see="09_arms#phases-why",
)
feedback_is_measured = check_of(
    "feedback_is_measured", model.measured, on=FETCH, needs=accepts_a_goal, see="09_arms#force-why"
)
percentage_rises = check_of(
    "percentage_rises", model.percentage, on=FETCH, needs=places_the_cup, see="08_navigation#zero-fix-why"
)
feedback_ends_with_the_goal = check_of(
    "feedback_ends_with_the_goal",
    model.no_late_feedback,
    on=FETCH,
    needs=places_the_cup,
    see="07_cancel_and_preempt#m13-why",
)
rejects_a_wrong_place = check_of(
    "rejects_a_wrong_place",
    model.rejects_frames,
    model.rejects_not_finite,
    title="It rejects a place in another frame than odom, and one that holds NaN or infinity",
    on=IMPOSSIBLE,
    needs=accepts_a_goal,
    see="09_arms#base-intro",
)
rejects_a_wrong_force = check_of(
    "rejects_a_wrong_force",
    model.rejects_forces,
    on=IMPOSSIBLE,
    needs=accepts_a_goal,
    see="09_arms#force-why",
)
knows_no_teapot = check_of(
    "knows_no_teapot",
    model.unknown_objects,
    model.says_why_it_aborted,
    on=UNKNOWN,
    needs=accepts_a_goal,
    see="09_arms#phases-why",
)
refuses_a_far_place = check_of(
    "refuses_a_far_place",
    model.out_of_reach,
    model.says_why_it_aborted,
    title="A place out of reach ends the goal with UNREACHABLE before anything moves",
    on=FAR_PLACE,
    needs=accepts_a_goal,
    see="09_arms#conventions",
)
refuses_a_far_cup = check_of(
    "refuses_a_far_cup",
    model.out_of_reach,
    model.says_why_it_aborted,
    title="A cup out of reach ends the goal with UNREACHABLE before anything moves",
    on=FAR_CUP,
    needs=accepts_a_goal,
    see="09_arms#conventions",
)
notices_an_empty_hand = check_of(
    "notices_an_empty_hand",
    model.empty_hand,
    model.says_why_it_aborted,
    points=2,
    on=TAKEN,
    needs=places_the_cup,
    see="09_arms#force-why",
)
withdraws_an_empty_hand = check_of(
    "withdraws_an_empty_hand",
    model.withdraws_empty,
    title="After that the hand is open and withdrawn",
    on=TAKEN,
    needs=notices_an_empty_hand,
    see="09_arms#force-why",
)
notices_a_lost_cup = check_of(
    "notices_a_lost_cup",
    model.lost_object,
    model.says_why_it_aborted,
    title="When the cup is lost while it is lifted the goal ends with DROPPED",
    points=2,
    on=SNATCHED,
    needs=lifts_the_cup,
    see="09_arms#slip-why",
)
gives_up_when_blocked = check_of(
    "gives_up_when_blocked",
    model.gives_up_in_time,
    model.says_why_it_aborted,
    on=BLOCKED,
    needs=places_the_cup,
    see="09_arms#phases-intro",
)
cancels_before_the_grasp = check_of(
    "cancels_before_the_grasp",
    model.leaves_the_cup,
    title="A cancel on the way to the cup ends CANCELED, with the hand withdrawn and the cup where it was",
    points=2,
    on=CANCEL,
    needs=accepts_a_goal,
    see="07_cancel_and_preempt#m1-why",
)
puts_the_cup_back = check_of(
    "puts_the_cup_back",
    model.puts_away,
    model.puts_down,
    title="A cancel soon after the cup was lifted puts it back where it stood, then ends CANCELED",
    points=3,
    on=HOLDING,
    needs=[lifts_the_cup, cancels_before_the_grasp],
    see="09_arms#lift-why",
)
has_one_hand = check_of(
    "has_one_hand",
    model.one_hand,
    model.places,
    points=2,
    on=TWO,
    needs=lifts_the_cup,
    see="07_cancel_and_preempt#preempt-why",
)
aborts_when_the_robot_falls = check_of(
    "aborts_when_the_robot_falls",
    model.tells_a_fall,
    model.says_why_it_aborted,
    on=FALL,
    needs=accepts_a_goal,
    see="07_cancel_and_preempt#fall-why",
)
ends_cleanly = standard.ends_cleanly(on=INTERRUPT, needs=server_appears, see=LOOK, clauses=[21])
