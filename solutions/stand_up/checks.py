"""The checks that students can see and run themselves."""

from __future__ import annotations

import math
from functools import partial

from autograder.authoring import Scenario, check_of, in_order, standard

from . import model

CROUCH = ("--crouch",)
BEGUN = 0.46  # m; at this height the pelvis has begun to rise from its crouch at 0.45 m
QUIET_TIME = 1.5  # s after a result, in which no more feedback may be published
STAY_TIME = 3.0  # s after a cancel or the time limit, in which the pelvis must keep its height


crouching = partial(in_order, robot=CROUCH)
played = partial(Scenario, robot=None)  # the scenario simulates the robot's topics itself
RISE = crouching(["go", "rise"], ["end", "rise"], ["wait", QUIET_TIME])
UNKNOWN = played("ask_before_anything_is_known")
LEANED_ON = crouching(["lean_on", 20.0, 4.0], ["go", "rise"], ["end", "rise"])
PUSHED = crouching(["go", "rise"], ["reach", BEGUN], ["lean_on", -20.0, 2.5], ["end", "rise"])
AHEAD, LEFT, BACK, RIGHT = 0.0, math.pi / 2, math.pi, -math.pi / 2  # rad, in base_link
GLIDES = played(
    "be_restless",
    {"speed": 0.06, "tilt": 0.0, "towards": [AHEAD, RIGHT], "calm": 0.0, "duration": 1.6, "lifted": 0.02},
)
SWAYS = played(
    "sway_before",
    {"nearly": 0.4, "light": 0.4, "even": 2, "uneven": 8, "swings": 3, "rests": 0.9, "rising": 0.75},
)
LEANS = played(
    "be_restless",
    {"speed": 0.0, "tilt": 0.12, "towards": [AHEAD, LEFT, BACK, RIGHT], "calm": 0.0, "duration": 1.2},
)
STANDING = in_order(["go", "standing"], ["end", "standing"], ["wait", QUIET_TIME])
CANCEL = crouching(
    *(["go", "canceled"], ["reach", 0.48], ["cancel", "canceled"], ["end", "canceled"], ["wait", STAY_TIME])
)
TWICE = crouching(["go", "first"], ["reach", BEGUN], ["go", "second"], ["end", "first"])
HELD = crouching(["hold", True], ["go", "held"], ["end", "held"], ["hold", False], ["wait", STAY_TIME])
FALL = crouching(["go", "rise"], ["reach", BEGUN], ["knock_over", 0.0, 80.0, 0.0], ["end", "rise"])
FALLEN = in_order(
    *(["knock_over", 0.0, 80.0, 0.0], ["wait", 1.0], ["go", "fallen"], ["end", "fallen"]), robot=()
)
INTERRUPT = in_order(["interrupt"])

LOOK = "07_cancel_and_preempt#conventions"
PHASES = "10_parameters_and_balance#phases-why"

server_appears = standard.server_appears(
    "the action stand_up", on=INTERRUPT, see="06_walk_to_a_pose#small-intro", clauses=[18]
)
accepts_a_goal = check_of(
    model.accepts, title="It accepts a goal while the robot crouches", on=RISE, needs=server_appears
)
once_it_accepts = partial(check_of, needs=accepts_a_goal)
rises = once_it_accepts([model.succeeds, model.names_no_error], points=2, on=RISE)
once_it_rises = partial(check_of, needs=rises)
rises_on_the_spot = once_it_rises(model.rises_in_place, on=RISE)
settles_before_it_succeeds = once_it_rises(
    model.settles,
    title="When the goal SUCCEEDS, the robot has been at full height, still and upright for 0.5 s",
    points=2,
    on=RISE,
)
once_it_settles = partial(check_of, needs=settles_before_it_succeeds)
waits_until_it_is_still = once_it_settles(
    [model.settles, model.succeeds],
    title="The goal succeeds only once the pelvis has been slower than 0.02 m/s for 0.5 s",
    on=GLIDES,
)
waits_until_it_is_upright = once_it_settles(
    [model.settles, model.succeeds],
    title="The goal succeeds only once the pelvis has leaned by less than 0.05 rad for 0.5 s",
    on=LEANS,
)
feedback_keeps_its_rate = once_it_accepts(model.feedback_at_5_hz, on=RISE)
names_its_phases = once_it_rises(model.names_its_phase, on=RISE)
percent_is_measured = once_it_rises(model.measures_percent, on=RISE)
percent_never_falls = once_it_accepts(
    model.never_loses_percent, title="percent_complete does not fall when the pelvis bobs", on=GLIDES
)
feedback_ends_with_the_goal = once_it_rises(model.feedback_ends, on=RISE)
rejects_before_anything_is_known = once_it_accepts(
    [model.rejects_the_unknown, model.accepts],
    title="It rejects a goal before the robot's first messages, and accepts one after them",
    on=UNKNOWN,
)
waits_for_even_loads = once_it_rises(
    [model.stays_down_while_uneven, model.names_shifting, model.succeeds],
    title="While somebody leans on the robot, it stays down, in the phase 'shifting'; then it rises",
    points=2,
    on=[LEANED_ON, SWAYS],
)
shifts_again_after_a_push = once_it_rises(
    [model.shifts_again, model.names_shifting, model.succeeds],
    title="When somebody leans on the rising robot, it stops and goes back to 'shifting'; then it rises",
    points=2,
    on=PUSHED,
)
accepts_a_goal_when_it_stands = check_of(
    model.accepts,
    title="It accepts a goal when the robot already stands, because a rejection carries no reason",
    on=STANDING,
    needs=server_appears,
    see=PHASES,
)
says_that_it_stands_already = check_of(
    [model.says_that_it_stands, model.says_why_it_aborted],
    title="A goal when the robot already stands is ABORTED at once with ALREADY_STANDING and a sentence",
    points=2,
    on=STANDING,
    needs=accepts_a_goal_when_it_stands,
)
cancels_under_way = once_it_accepts(
    [model.cancels, model.names_no_error],
    title="A cancel while the robot rises is accepted, and the goal ends CANCELED",
    points=2,
    on=CANCEL,
)
stays_where_it_was_canceled = check_of(
    model.stays_where_it_ended,
    title="After the cancel the pelvis stays at the height it had reached",
    points=2,
    on=CANCEL,
    needs=cancels_under_way,
)
rejects_a_second_goal = once_it_rises(
    [model.rejects_while_busy, model.succeeds],
    title="It rejects a second goal while the first is active, and the first goes on",
    on=TWICE,
)
gives_up_in_time = once_it_accepts(
    [model.keeps_the_limit, model.names_no_error, model.says_why_it_aborted],
    title="When the robot is held down, the goal is ABORTED after 12 s with a sentence",
    points=2,
    on=HELD,
)
stays_down_after_the_limit = check_of(
    model.stays_where_it_ended,
    title="After the time limit the robot stays down, also when it is no longer held",
    on=HELD,
    needs=gives_up_in_time,
    see="08_navigation#late-why",
)
aborts_when_the_robot_falls = once_it_accepts(
    [model.ends_with_a_fall, model.says_why_it_aborted],
    title="When the robot falls, the goal is ABORTED with FELL and a sentence",
    on=FALL,
)
knows_that_a_fall_is_the_end = check_of(model.refuses_the_floor, on=FALLEN, needs=server_appears)
ends_cleanly = standard.ends_cleanly(on=INTERRUPT, needs=server_appears, see=LOOK, clauses=[18])
