"""The checks that students can see and run themselves."""

from __future__ import annotations

import math
from functools import partial

from autograder.authoring import check_of, standard

from . import model
from .sequences import AFTERWARDS, Part, cancel, drop, fetch, levels, preempt, scenario

DEADLOCK = "11_capstone#blocked-why"
ORPHANS = "11_capstone#patient-why"
GOES_DOWN = "11_capstone#careful-why"
GIVES_UP = "11_capstone#ways-why"
BATTERY_LESSON = "08_navigation#guard-traps-why"
SILENCE_LESSON = "11_capstone#dead-why"

IMPOSSIBLE = Part(
    [
        ["ask", "wrong frame", "place_pose.header.frame_id", "map"],
        ["ask", "NaN position", "place_pose.pose.position.x", math.nan],
        ["ask", "NaN force", "grasp_force", math.nan],
        ["ask", "infinite force", "grasp_force", math.inf],
        ["ask", "no force", "grasp_force", 0.0],
        ["wait", AFTERWARDS],
        ["interrupt"],
    ]
)
INTERRUPT = scenario(IMPOSSIBLE, battery=None)
GOOD = scenario(fetch("fetch", *levels(0.71, 0.55, 0.32)))
LOW_BEFORE = scenario(fetch("low battery", children=()), battery=0.12)
TO_THE_TABLE = scenario(drop("fetch", 0.17, 1))
HOLDING = scenario(drop("fetch", 0.15, 2, "lifting"))
CANCELED_WALK = scenario(cancel("fetch", 1, stops=(True, 1.5)))
FAILS = {"ends": "ABORTED", "code": 3}
FAILING = scenario(
    fetch("a walk is aborted", children=[{**FAILS, "said": "the way took longer than 48 s"}]),
    fetch("a grasp is aborted", children=[{}, {**FAILS, "said": "the fingers closed on nothing"}]),
    fetch("a walk is rejected", children=[{"accepted": False}]),
)
SILENT = scenario(
    fetch("fetch", children=[{"silent_after": 0.6, "takes": 60.0}]),
    fetch(
        "it speaks again",
        children=[{"silent_after": 0.6, "silent_for": 6.5, "takes": 60.0, "stops": (False, 0.0)}],
    ),
)
LATE = scenario(fetch("late", children=[{"answered_after": 6.5, "takes": 60.0}]), Part([["wait", 2.0]]))
PREEMPTED = scenario(preempt("old", "new", 1, stops=(True, 1.5)))

on_good = partial(check_of, on=GOOD, see=DEADLOCK)

server_appears = standard.server_appears(
    "the action fetch", on=INTERRUPT, see="07_cancel_and_preempt#fix-file", clauses=[31]
)
goes_to_the_table = on_good(model.sets_out, needs=server_appears)
takes_the_object = on_good(
    model.takes_it,
    title="When the robot has arrived, it sends pick_and_place the goal to put the object onto the tray",
    points=2,
    needs=goes_to_the_table,
)
fetches = on_good(
    model.fetches_it,
    title="The robot comes home, the object is put down, and then fetch SUCCEEDS",
    points=2,
    needs=takes_the_object,
)
fills_the_result = check_of(model.reports_the_object, on=GOOD, needs=fetches)
passes_feedback_on = check_of(model.hands_feedback_on, on=GOOD, needs=takes_the_object)
once_it_sets_out = partial(check_of, needs=goes_to_the_table)
rejects_what_is_knowably_wrong = once_it_sets_out(model.rejects_the_impossible, on=INTERRUPT)
does_not_set_out_on_a_low_battery = once_it_sets_out(
    model.does_nothing_when_low,
    title="With the battery at 0.12 fetch sends no goal to a child, and ends ABORTED naming the battery",
    on=LOW_BEFORE,
    see=BATTERY_LESSON,
)
says_why_a_child_failed = once_it_sets_out(
    model.says_who_failed,
    title="If a child is rejected or aborted, fetch ends ABORTED; error_msg has the action's name and the child's "
    "reason",
    points=2,
    on=FAILING,
    see=ORPHANS,
)
cancels_a_silent_child = once_it_sets_out(
    [*model.always, model.cancels_the_silent, model.gives_up_the_silent],
    title="A child without feedback for 5 s is canceled; when it has ended, fetch ends ABORTED naming the action",
    points=2,
    on=SILENT,
    see=SILENCE_LESSON,
)
cancels_a_late_child = check_of(
    [model.cancels_the_late, model.gives_up_the_unanswered],
    title="A child that is accepted only after more than 5 s is canceled at once, as fetch no longer waits for it",
    points=2,
    on=LATE,
    needs=cancels_a_silent_child,
    see="03b_clients_in_bad_company#late-why",
)
cancel_goes_down = once_it_sets_out(
    model.obeys_a_cancel,
    title="A cancel of fetch also cancels the active child, and fetch is CANCELED when the child has ended",
    points=3,
    on=CANCELED_WALK,
)
new_goal_preempts_the_old = check_of(
    [*model.gives_way, model.ends_well],
    title="A new goal preempts the old: the old goal's child is canceled; when it has ended, the old goal is ABORTED "
    "and the new one begins",
    points=2,
    on=PREEMPTED,
    needs=[cancel_goes_down, fetches],
    see="11_capstone#newest-why",
)
gives_up_before_the_grasp = once_it_sets_out(
    model.stops_in_time,
    title="If the battery gets low before the grasp, the child is canceled; then the robot goes home, and fetch is "
    "ABORTED",
    points=3,
    on=TO_THE_TABLE,
    see=GIVES_UP,
)
finishes_placing_first = check_of(
    model.finishes_first,
    title="If the battery gets low while the hand holds the object, it is placed first; then the robot goes home, and "
    "fetch is ABORTED",
    points=3,
    on=HOLDING,
    needs=takes_the_object,
    see=GIVES_UP,
)
ends_cleanly = standard.ends_cleanly(on=INTERRUPT, needs=server_appears, clauses=[31])
