"""The hidden checks, which only the instructor's grading runs."""

from __future__ import annotations

import math
from functools import partial
from random import Random
from typing import Any

from autograder.authoring import Scenario, check_of, shuffled
from autograder.classroom.hidden_checks import standard_hidden

from . import checks, model
from .checks import CROUCH, crouching, played

LEAN_DURATION = 8.0  # s, longer than a goal may take to end after a cancel
STAY_TIME = 2.0  # s after a goal's end, in which the pelvis must keep its height


def _side(random: Random) -> int:
    return random.choice((-1, 1))


def _steps(random: Random) -> dict[str, Any]:
    """Cancel while it rises; push during the next goal; send one when it stands; crouch twice; let it fall.

    In one crouch a goal is canceled in the phase 'shifting', in the other two goals are sent at once.
    """

    def height(least: float, most: float) -> float:
        return round(random.uniform(least, most), 3)

    first = height(0.47, 0.5)
    push = [round(random.uniform(-2.0, 2.0), 1), round(_side(random) * random.uniform(9.0, 10.0), 1), 0.0]
    shifting = [
        *(
            ["crouch", height(0.5, 0.55)],
            ["lean_on", _side(random) * 20.0, LEAN_DURATION],
            ["go", "leaned on"],
        ),
        *(["wait", 1.5], ["cancel", "leaned on"], ["end", "leaned on"], ["wait", LEAN_DURATION]),
    ]
    anew = [
        *(["crouch", height(0.5, 0.55)], ["go_together", "one", "other"], ["end", "one"], ["end", "other"]),
        ["wait", STAY_TIME],
    ]
    return {
        "steps": [
            *(["go", "canceled"], ["reach", first], ["cancel", "canceled"], ["end", "canceled"]),
            *(["wait", STAY_TIME], ["go", "pushed"], ["reach", round(first + 0.055, 3)], ["push", *push]),
            *(["go", "meanwhile"], ["end", "pushed"], ["wait", 1.0], ["go", "up"], ["end", "up"]),
            *shuffled(random, [shifting, anew]),
            *(["crouch", 0.5], ["go", "last"], ["reach", 0.52]),
            *(["knock_over", 0.0, _side(random) * 80.0, 0.0], ["end", "last"]),
            *(["wait", 1.0], ["go", "lying"], ["end", "lying"]),
        ]
    }


ANY_ORDER = Scenario("in_order", _steps, robot=CROUCH)
SWAYS = played(
    "sway_before",
    lambda random: {
        "nearly": random.choice((0.7, 1 / 0.7)),
        "light": round(random.uniform(0.3, 0.45), 2),
        "even": random.choice((2, 3)),
        "uneven": random.choice((7, 8, 9)),
        "swings": 6,
        "rests": round(random.uniform(0.83, 0.88) ** random.choice((-1, 1)), 3),
    },
)
ASIDE = played(
    "step_aside_at_the_top",
    lambda random: {
        "light": round(random.choice((random.uniform(0.3, 0.5), random.uniform(2.0, 3.0))), 2),
        "duration": 1.5,
    },
)
FIDGETS = played(
    "be_restless",
    lambda random: {
        "speed": 0.06,
        "tilt": round(random.choice((0.0, 0.1)), 2),
        "towards": [round(random.uniform(-math.pi, math.pi), 2)],
        "calm": round(random.uniform(0.1, 0.2), 2),
        "duration": 3.0,
    },
)
TIRES = played(
    "never_get_up",
    lambda random: {
        "even": round(random.uniform(0.9, 1.1), 2),
        "uneven": round(random.uniform(0.6, 0.8), 2),
        "times": 5,
    },
)
OTHER_NAMESPACE = crouching(["go", "rise"], ["end", "rise"], namespace="/lab_7/robot")

in_any_order = partial(check_of, on=ANY_ORDER)

rises_from_any_height = in_any_order(
    [
        model.succeeds,
        model.settles,
        model.measures_percent,
        model.never_loses_percent,
        model.names_its_phase,
        model.feedback_at_5_hz,
        model.feedback_ends,
        model.rejects_while_busy,
        model.takes_one_of_several,
    ],
    title="It rises from any crouch, counts percent_complete from there, and fulfils every clause meanwhile",
    points=2,
    needs=[checks.settles_before_it_succeeds, checks.percent_is_measured],
    see="08_navigation#zero-why",
)
stands_already_after_it_has_risen = in_any_order(
    [model.says_that_it_stands, model.says_why_it_aborted],
    title="A goal after one that SUCCEEDED is accepted, then ABORTED with ALREADY_STANDING",
    needs=[checks.rises, checks.says_that_it_stands_already],
)
rises_after_a_cancel = in_any_order(
    [
        model.accepts,
        model.cancels,
        model.stays_where_it_ended,
        model.names_no_error,
        model.status_in_order,
        model.measures_percent,
        model.ends_with_a_fall,
        model.refuses_the_floor,
    ],
    title="After a goal has ended, the next one starts from the height reached, until the robot falls",
    needs=[checks.percent_is_measured, checks.stays_where_it_was_canceled],
    see="07_cancel_and_preempt#fix-intro",
)
waits_until_loads_stay_even = check_of(
    [model.stays_down_while_uneven, model.succeeds],
    title="It does not rise while loads are even only for a moment, or 30 % apart",
    on=SWAYS,
    needs=checks.waits_for_even_loads,
    see="10_parameters_and_balance#steady-gap",
)
shifts_again_from_settling = check_of(
    [model.shifts_again, model.names_shifting, model.succeeds],
    title="Uneven loads lead back to 'shifting' also from 'settling'",
    on=ASIDE,
    needs=[checks.settles_before_it_succeeds, checks.waits_for_even_loads, checks.shifts_again_after_a_push],
)
waits_until_calm_lasts = check_of(
    [model.settles, model.succeeds],
    title="The goal does not succeed when the robot is still and upright only for a moment",
    on=FIDGETS,
    needs=checks.waits_until_it_is_still,
    see="10_parameters_and_balance#steady-gap",
)
cancels_while_it_shifts = in_any_order(
    [model.cancels, model.stays_down_while_uneven, model.names_shifting, model.stays_where_it_ended],
    title="A cancel in the phase 'shifting' ends CANCELED, and the robot stays down",
    needs=[checks.cancels_under_way, checks.waits_for_even_loads],
)
the_limit_holds_for_all_phases = check_of(
    [model.keeps_the_limit, model.names_no_error, model.says_why_it_aborted],
    title="The 12 s count from acceptance, and also end a goal in the phase 'shifting'",
    on=TIRES,
    needs=[checks.gives_up_in_time, checks.waits_for_even_loads],
)
survives_a_push = in_any_order(
    [model.rises_though_pushed, model.settles],
    title="When the robot is pushed hard while it rises, the goal still succeeds",
    needs=[checks.settles_before_it_succeeds, checks.shifts_again_after_a_push],
)
works_in_any_namespace = standard_hidden.works_in_any_namespace(
    "raises the robot", model.succeeds, on=OTHER_NAMESPACE, needs=checks.rises, clauses=[18]
)
