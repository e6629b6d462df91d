"""The checks that students can see and run themselves."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from autograder.authoring import Scenario, check_of, in_order, standard

from . import model

TABLE = ("--scene", "table")
AFTERWARDS = 1.5  # s after a result, for which the scenario goes on recording
PLACE = [0.35, -0.27]  # x, y m in odom
HERE = [0.33, -0.25]


def at_the_table(*steps: Sequence[Any], **inputs: Any) -> Scenario:
    """Return the scenario of these steps, which records hand and cup until some time after the last step."""
    return in_order(*steps, ["wait", AFTERWARDS], robot=TABLE, **inputs)


FETCH = at_the_table(["go", "fetch", PLACE], ["arrive", "fetch"])
IMPOSSIBLE = in_order(
    ["go", "wrong frame", HERE, 10.0, "cup", "map"],
    ["go", "no frame", HERE, 10.0, "cup", ""],
    ["go", "NaN place", [math.nan, -0.25]],
    ["go", "infinite place", [0.33, -math.inf]],
    *(["go", f"force {force}", HERE, force] for force in (math.nan, 0.0, -8.0, 40.0)),
    ["wait", AFTERWARDS],
    watched=[],
)
UNKNOWN = in_order(["go", "unknown", HERE, 10.0, "teapot"], ["arrive", "unknown"], watched=[])
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
INTERRUPT = in_order(["interrupt"], watched=[])

LOOK = "07_cancel_and_preempt#conventions"

server_appears = standard.server_appears(
    "the action pick_and_place", on=INTERRUPT, see="07_cancel_and_preempt#fix-file", clauses=[21]
)
accepts_a_goal = check_of(
    model.accepts,
    title="It accepts a goal with a place in frame odom and a force of 10 N",
    on=FETCH,
    needs=server_appears,
)
places_the_cup = check_of([model.places, model.puts_down], points=3, on=FETCH, needs=accepts_a_goal)
lifts_the_cup = check_of(model.lifts, on=FETCH, needs=accepts_a_goal)
keeps_the_force = check_of(model.keeps_force, points=2, on=FETCH, needs=lifts_the_cup)
fills_the_result = check_of(model.filled_result, on=FETCH, needs=places_the_cup)
feedback_keeps_its_rate = check_of(model.feedback_at_5_hz, on=FETCH, needs=accepts_a_goal)
names_its_stages = check_of(model.names_stages, on=FETCH, needs=lifts_the_cup)
stages_are_true = check_of(model.true_stages, on=FETCH, needs=names_its_stages)
feedback_is_measured = check_of(model.measured, on=FETCH, needs=accepts_a_goal)
percentage_rises = check_of(model.percentage, on=FETCH, needs=places_the_cup)
feedback_ends_with_the_goal = check_of(model.no_late_feedback, on=FETCH, needs=places_the_cup)
rejects_a_wrong_place = check_of(
    [model.rejects_frames, model.rejects_not_finite],
    title="It rejects a place_pose in another frame than odom, and one with a NaN or infinite coordinate",
    on=IMPOSSIBLE,
    needs=accepts_a_goal,
    see="09_arms#base-intro",
)
rejects_a_wrong_force = check_of(
    model.rejects_forces, on=IMPOSSIBLE, needs=accepts_a_goal, see="09_arms#force-why"
)
knows_no_teapot = check_of(
    [model.unknown_objects, model.says_why_it_aborted], on=UNKNOWN, needs=accepts_a_goal
)
refuses_a_far_place = check_of(
    [model.out_of_reach, model.says_why_it_aborted],
    title="A place out of reach ends the goal with UNREACHABLE before anything moves",
    on=FAR_PLACE,
    needs=accepts_a_goal,
)
refuses_a_far_cup = check_of(
    [model.out_of_reach, model.says_why_it_aborted],
    title="A cup out of reach ends the goal with UNREACHABLE before anything moves",
    on=FAR_CUP,
    needs=accepts_a_goal,
)
notices_an_empty_hand = check_of(
    [model.empty_hand, model.says_why_it_aborted], points=2, on=TAKEN, needs=lifts_the_cup
)
withdraws_an_empty_hand = check_of(model.withdraws_empty, on=TAKEN, needs=notices_an_empty_hand)
notices_a_lost_cup = check_of(
    [model.lost_object, model.says_why_it_aborted],
    title="When the cup is lost while it is lifted, the goal ends with DROPPED",
    points=2,
    on=SNATCHED,
    needs=lifts_the_cup,
)
gives_up_when_blocked = check_of(
    [model.gives_up_in_time, model.says_why_it_aborted], on=BLOCKED, needs=lifts_the_cup
)
cancels_before_the_grasp = check_of(
    model.leaves_the_cup,
    title="A cancel before the hand grasps the cup ends CANCELED, with the hand withdrawn and the cup where it was",
    points=2,
    on=CANCEL,
    needs=accepts_a_goal,
)
puts_the_cup_back = check_of(
    [model.puts_away, model.puts_down],
    title="A cancel soon after the cup was lifted puts it back where it stood, then ends CANCELED",
    points=3,
    on=HOLDING,
    needs=[lifts_the_cup, cancels_before_the_grasp],
)
has_one_hand = check_of(
    [model.one_hand, model.places], points=2, on=TWO, needs=[places_the_cup, lifts_the_cup]
)
aborts_when_the_robot_falls = check_of(
    [model.tells_a_fall, model.says_why_it_aborted], on=FALL, needs=accepts_a_goal
)
ends_cleanly = standard.ends_cleanly(on=INTERRUPT, needs=server_appears, see=LOOK, clauses=[21])
