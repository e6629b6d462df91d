"""The checks that students can see and run themselves."""

from __future__ import annotations

from functools import partial

from autograder.authoring import check_of, in_order, program, standard

from . import model

TWO_CALLBACKS = "10_parameters_and_balance#book-why"
ALL_AT_ONCE = "10_parameters_and_balance#atomic-fix-why"
WHO_SEES_IT = "10_parameters_and_balance#guarded-gap"

without_robot = partial(in_order, robot=None)
SETS = without_robot(
    *(["describe"], ["ask"], ["settle"], ["set_each", {"kp_pitch": 320.0}], ["settle"]),
    *(["set_together", {"kp_roll": 350.0, "kd_roll": 44.0, "max_torque": 4000.0}], ["settle"]),
    *(["set_each", {"kd_roll": 40.0, "kp_pitch": 300.0}], ["settle"], ["ask"], ["listen", "a late robot"]),
)
REFUSALS = without_robot(
    *(["ask"], ["settle"], ["set_each", {"kp_pitch": 40.0}], ["set_each", {"kp_roll": 12.5}]),
    *(["set_each", {"kd_pitch": -5.0}], ["set_each", {"max_torque": -1.0}], ["settle"]),
    *(["set_each", {"max_torque": 0.0}], ["settle"], ["set_each", {"kd_roll": 44.0}], ["settle"]),
)
ALL_OR_NONE = without_robot(
    *(["ask"], ["settle"], ["set_together", {"kp_pitch": 333.0, "kd_roll": -3.0}], ["settle"]),
    *(["set_together", {"kd_pitch": 41.0, "kp_roll": 340.0, "kp_pitch": 20.0}], ["settle"]),
    *(["ask"], ["set_each", {"max_torque": 5000.0}], ["settle"]),
)
AT_START = {"kp_pitch": 310.0, "kd_roll": 41.5}
# This scenario starts a robot because the robot detects an overloaded machine, where Python takes seconds to exit.
START = in_order(
    *(["ask"], ["settle"]), parameters=AT_START, latched=True, interrupt=True, started_with=AT_START
)
WEAK_START = program("start_with", {"name": "kp_pitch", "value": "51.0"}, timed=False)
PUSH = in_order(
    *(["ask"], ["settle"], ["set_together", {"kp_pitch": 340.0, "kp_roll": 370.0, "kd_roll": 46.0}]),
    *(["settle"], ["push", 10.0, 0.0, 0.0]),
    robot=(),
)

of_sets = partial(check_of, on=SETS)

server_appears = of_sets(model.offers_its_parameters)
declares_the_robots_gains = of_sets(
    model.has_its_gains,
    title="The five parameters are doubles, with the robot's own gains as defaults",
    needs=server_appears,
)
describes_its_parameters = of_sets(model.describes_each, needs=server_appears)
publishes_what_it_accepted = of_sets(
    [model.accepts_the_table, model.publishes_them_in_time],
    title="After an accepted set, all five current gains are published on balance_gains",
    points=2,
    needs=declares_the_robots_gains,
    see=TWO_CALLBACKS,
)
publishes_once = of_sets(model.one_message_each, points=2, needs=publishes_what_it_accepted)
refuses_bad_gains = check_of(
    [model.refuses_weak_gains, model.refuses_limits, model.refuses_negative_gains, model.gives_a_reason],
    title="A gain that is negative, or too small to hold the trunk, is rejected with a reason",
    points=2,
    on=REFUSALS,
    needs=server_appears,
    see=TWO_CALLBACKS,
)
says_nothing_of_refused_gains = check_of(
    [model.publishes_nothing_for_rejected_sets, model.accepts_the_table, model.one_message_each],
    on=REFUSALS,
    needs=publishes_once,
)
sets_all_or_none = check_of(
    [
        model.refuses_negative_gains,
        model.refuses_weak_gains,
        model.gives_a_reason,
        model.publishes_nothing_for_rejected_sets,
        model.has_what_it_accepted,
        model.accepts_the_table,
        model.publishes_only_what_was_accepted,
    ],
    title="If one gain of an atomic set is invalid, none of its gains is kept, published or applied later",
    points=2,
    on=ALL_OR_NONE,
    needs=says_nothing_of_refused_gains,
    see=ALL_AT_ONCE,
)
keeps_the_last_gains = of_sets(model.keeps_the_last, needs=publishes_what_it_accepted)
publishes_at_the_start = check_of(
    [model.has_its_gains, model.publishes_its_start_once],
    title=model.publishes_its_start_once.sentence,
    on=START,
    needs=keeps_the_last_gains,
    see=WHO_SEES_IT,
)
refuses_a_bad_start = check_of(
    model.refuses_to_start,
    title="Started with an invalid gain, it exits with status 1 and a line that says why",
    points=2,
    on=WEAK_START,
    needs=server_appears,
)
survives_a_push = check_of(
    [model.accepts_the_table, model.publishes_them_in_time, model.survives],
    title=model.survives.sentence,
    points=2,
    on=PUSH,
    needs=publishes_what_it_accepted,
)
ends_cleanly = standard.ends_cleanly(on=START, needs=server_appears, clauses=[15])
