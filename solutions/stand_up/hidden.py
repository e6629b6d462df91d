"""What only the instructor's grading checks."""

from __future__ import annotations

import math

from autograder.authoring.checks import Scenario, check
from autograder.authoring.transcript import Transcript

from .checks import (
    CROUCH,
    cancels_under_way,
    gives_up_in_time,
    percent_is_measured,
    rises,
    says_that_it_stands_already,
    settles_before_it_succeeds,
    shifts_again_after_a_push,
    stays_where_it_was_canceled,
    waits_for_even_loads,
    waits_until_it_is_still,
)
from .endings import require_standing_told, require_stayed_down
from .leaning import require_leaned_on
from .played import require_calm, require_even_for_a_while, require_shifted_at_the_top, require_tired
from .reports import require_measured_percent
from .rising import GAIN, require_low, require_risen, require_settled


def _side(random) -> int:
    return random.choice((-1, 1))


ANY_HEIGHT = Scenario("rise_from", lambda random: {"height": round(random.uniform(0.50, 0.57), 3)})
RISE_TWICE = Scenario("rise_twice", robot=CROUCH)
AGAIN = Scenario(
    "cancel_and_rise_again", lambda random: {"height": round(random.uniform(0.48, 0.52), 3)}, robot=CROUCH
)
SWAYS = Scenario(
    "sway_before",
    lambda random: {
        "nearly": random.choice((0.7, 1 / 0.7)),
        "light": round(random.uniform(0.3, 0.45), 2),
        "even": random.choice((2, 3)),
        "uneven": random.choice((7, 8, 9)),
        "swings": 6,
    },
    robot=None,
)
ASIDE = Scenario(
    "step_aside_at_the_top",
    lambda random: {
        "light": round(random.choice((random.uniform(0.3, 0.5), random.uniform(2.0, 3.0))), 2),
        "duration": 1.5,
    },
    robot=None,
)
FIDGETS = Scenario(
    "be_restless",
    lambda random: {
        "speed": 0.06,
        "tilt": round(random.choice((0.0, 0.1)), 2),
        "towards": [round(random.uniform(-math.pi, math.pi), 2)],
        "calm": round(random.uniform(0.1, 0.2), 2),
        "duration": 3.0,
    },
    robot=None,
)
SHIFTING = Scenario(
    "cancel_while_it_shifts",
    lambda random: {"force": [0.0, _side(random) * 20.0, 0.0], "duration": 12.0},
    robot=CROUCH,
)
TIRES = Scenario(
    "never_get_up",
    lambda random: {
        "even": round(random.uniform(0.9, 1.1), 2),
        "uneven": round(random.uniform(0.6, 0.8), 2),
        "times": 5,
    },
    robot=None,
)
PUSH = Scenario(
    "push",
    lambda random: {
        "impulse": [
            round(random.uniform(-2.0, 2.0), 1),
            round(_side(random) * random.uniform(9.0, 10.0), 1),
            0.0,
        ],
        "height": round(random.uniform(0.48, 0.56), 3),
    },
    robot=CROUCH,
)
OTHER_NAMESPACE = Scenario("rise", robot=CROUCH, namespace="/lab_7/robot")


@check(
    points=2,
    on=ANY_HEIGHT,
    needs=[settles_before_it_succeeds, percent_is_measured],
    see="08_navigation#zero-why",
    clauses=[6, 10],
)
def rises_from_any_height(run: Transcript) -> None:
    """It rises from any crouch, and counts its percents from there"""
    require_low(run.goal("rise"), run.params["height"])
    require_settled(run.goal("rise"))
    require_measured_percent(run.goal("rise"))


@check(on=RISE_TWICE, needs=[rises, says_that_it_stands_already], see="09_arms#phases-why", clauses=[2])
def stands_already_after_it_has_risen(run: Transcript) -> None:
    """A goal after a success is accepted, and ABORTED with ALREADY_STANDING"""
    require_risen(run.goal("rise"))
    require_standing_told(run.goal("again"))


@check(
    on=AGAIN,
    needs=[percent_is_measured, stays_where_it_was_canceled],
    see="07_cancel_and_preempt#fix-intro",
    clauses=[6, 10],
)
def rises_after_a_cancel(run: Transcript) -> None:
    """After a cancel a new goal goes on from the height reached"""
    run.goal("canceled").require_canceled()
    require_risen(run.goal("again"))
    require_measured_percent(run.goal("again"))


@check(on=SWAYS, needs=waits_for_even_loads, see="09_arms#steady-gap", clauses=[4])
def waits_until_loads_stay_even(run: Transcript) -> None:
    """Loads that are even for a moment only, or 30 % apart, do not let it rise"""
    require_even_for_a_while(run, run.goal("rise"))


@check(
    on=ASIDE,
    needs=[settles_before_it_succeeds, waits_for_even_loads, shifts_again_after_a_push],
    see="09_arms#phases-why",
    clauses=[7],
)
def shifts_again_from_settling(run: Transcript) -> None:
    """Uneven loads lead back to shifting also from settling"""
    require_shifted_at_the_top(run, run.goal("rise"))


@check(
    on=FIDGETS,
    needs=[settles_before_it_succeeds, waits_until_it_is_still],
    see="09_arms#steady-gap",
    clauses=[6],
)
def waits_until_calm_lasts(run: Transcript) -> None:
    """A robot that is calm for a moment only has not settled"""
    require_calm(run, run.goal("rise"))


@check(
    on=SHIFTING,
    needs=[cancels_under_way, waits_for_even_loads],
    see="07_cancel_and_preempt#m1-why",
    clauses=[12],
)
def cancels_while_it_shifts(run: Transcript) -> None:
    """A cancel in shifting ends CANCELED, and the robot stays down"""
    goal = run.goal("rise")
    request = goal.require_canceled()
    require_leaned_on(run)
    require_stayed_down(goal, request.t, GAIN)


@check(
    on=TIRES,
    needs=[gives_up_in_time, waits_for_even_loads],
    see="08_navigation#late-why",
    clauses=[14],
)
def the_limit_holds_for_all_phases(run: Transcript) -> None:
    """The 12 s begin once, and are over in shifting, too"""
    require_tired(run, run.goal("rise"))


@check(
    on=PUSH,
    needs=[settles_before_it_succeeds, shifts_again_after_a_push],
    see="09_arms#phases-why",
    clauses=[6, 7],
)
def survives_a_push(run: Transcript) -> None:
    """Pushed hard on its way, it rises all the same"""
    require_settled(run.goal("rise"))


@check(on=OTHER_NAMESPACE, needs=rises, see="01_robot_and_graph#names-why", clauses=[18])
def works_in_any_namespace(run: Transcript) -> None:
    """Started in another namespace, it raises the robot there"""
    require_risen(run.goal("rise"))
