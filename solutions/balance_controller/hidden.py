"""What only the instructor's grading checks."""

from __future__ import annotations

import math
from random import Random
from typing import Any

from autograder.authoring.checks import Scenario, check, program
from autograder.authoring.transcript import Transcript

from .checks import (
    FROM_THE_START,
    PUSHED,
    TWO_CALLBACKS,
    publishes_once,
    publishes_what_it_accepted,
    refuses_a_bad_start,
    refuses_bad_gains,
    sets_all_or_none,
    survives_a_push,
)
from .gains import HIGHEST, NAMES, TOPPLE, lowest_gains, set_each, set_together, sound_gains
from .published import require_accepted, require_once, require_published, require_silence
from .refused import require_bad_start_refused, require_refused
from .standing import require_standing_after_push

AN_INTEGER = "10_parameters_and_balance#int-why"


def _any_gains(random: Random) -> dict[str, Any]:
    """Draw a set of all gains, some of them one after the other, one of these again, and the ends of the table."""
    chosen = random.sample(NAMES, 3)
    later = sound_gains(random)
    same = random.choice(chosen)
    return {
        "sets": [
            set_together("all gains", **sound_gains(random)),
            set_each("some gains", **{name: later[name] for name in chosen}),
            set_each("the same again", **{same: later[same]}),
            set_each("the lowest", **lowest_gains(random)),
            set_together("the highest", **HIGHEST),
        ]
    }


def _any_push(random: Random) -> dict[str, Any]:
    """Draw gains that hold the robot, and the direction of a push (10 N·s in odom)."""
    heading = random.uniform(-math.pi, math.pi)
    return {
        "sets": [set_together("new gains", **sound_gains(random))],
        "impulse": [10.0 * math.cos(heading), 10.0 * math.sin(heading), 0.0],
    }


NO_NUMBERS = Scenario(
    "set_gains",
    {
        "sets": [
            set_each("NaN", kd_pitch=math.nan),
            set_each("NaN for kp", kp_roll=math.nan),
            set_each("infinite", max_torque=math.inf),
            set_each("infinite kp", kp_pitch=math.inf),
            set_each("infinite kd", kd_roll=math.inf),
            set_together("NaN among good ones", kp_pitch=300.0, kd_roll=math.nan),
        ]
    },
    robot=None,
)
INTEGERS = Scenario(
    "set_gains",
    {"sets": [set_each("an integer", kp_pitch=300), set_together("integers", kd_pitch=40, kp_roll=310.0)]},
    robot=None,
)
EXACTLY = Scenario(
    "set_gains",
    {
        "sets": [
            set_each("51 in pitch", kp_pitch=TOPPLE),
            set_each("51 in roll", kp_roll=TOPPLE),
            set_each("no torque", max_torque=0.0),
        ]
    },
    robot=None,
)
BEHIND = Scenario(
    "set_gains",
    {
        "sets": [
            set_together("good ones and the limit", kd_pitch=41.0, kp_roll=340.0, kp_pitch=TOPPLE),
            set_each("a good one alone", max_torque=5000.0),
        ]
    },
    robot=None,
)
ANY_GAINS = Scenario("set_gains", _any_gains, robot=None)
ANY_PUSH = Scenario("push", _any_push)
START_AT_THE_LIMIT = program("start_with", {"name": "kp_roll", "value": "51.0"}, timed=False)
START_WITH_NAN = program("start_with", {"name": "kd_pitch", "value": ".nan"}, timed=False)
START_WITH_AN_INTEGER = program("start_with", {"name": "kp_pitch", "value": "300"}, timed=False)
NEGATIVE_START = program("start_with", {"name": "kd_roll", "value": "-2.0"}, timed=False)
OTHER_NAMESPACE = Scenario(
    "set_gains",
    {"sets": [set_each("one gain", kd_roll=45.0)]},
    robot=None,
    namespace="/lab_7/robot",
)


@check(points=1, on=NO_NUMBERS, needs=refuses_bad_gains, see="02_services#nan", clauses=[3, 5])
def refuses_what_is_no_number(run: Transcript) -> None:
    """NaN and infinity are refused with a reason"""
    for one in run.params["sets"]:
        require_refused(
            run,
            one["name"],
            "it is not finite",
            "Infinity is above every lower limit: end each range at a number, or ask math.isfinite()."
            if math.inf in one["values"].values()
            else "Every comparison with NaN is false, so a test such as `value < 0.0` lets it through: ask "
            "math.isfinite().",
        )


@check(points=1, on=INTEGERS, needs=refuses_bad_gains, see=AN_INTEGER, clauses=[4, 5])
def refuses_integers(run: Transcript) -> None:
    """An integer for a double is refused with a reason"""
    for one in run.params["sets"]:
        require_refused(
            run,
            one["name"],
            "it has an integer, and the parameter is a double",
            "Leave dynamic_typing alone: a parameter that is declared with a float stays a double.",
        )


@check(points=1, on=EXACTLY, needs=refuses_bad_gains, see=TWO_CALLBACKS, clauses=[3, 5])
def refuses_the_limit_itself(run: Transcript) -> None:
    """A kp of exactly 51 N·m/rad and a max_torque of 0 are refused, too"""
    for name, because in (
        ("51 in pitch", "kp_pitch has to be above 51"),
        ("51 in roll", "kp_roll has to be above 51"),
        ("no torque", "max_torque has to be above 0, and the robot ignores such gains"),
    ):
        require_refused(
            run,
            name,
            because,
            "A floating_point_range includes both of its ends: refuse the limit itself in the on-set callback.",
        )


@check(
    points=1,
    on=BEHIND,
    needs=[sets_all_or_none, refuses_the_limit_itself],
    see=TWO_CALLBACKS,
    clauses=[9, 10],
)
def leaves_nothing_behind(run: Transcript) -> None:
    """What the on-set callback refuses at the end of an atomic set leaves nothing behind"""
    require_silence(run, "good ones and the limit")
    require_accepted(run, "a good one alone")
    require_once(run, "a good one alone")


@check(points=2, on=ANY_GAINS, needs=publishes_once, see=TWO_CALLBACKS, clauses=[6, 7, 8])
def publishes_any_gains(run: Transcript) -> None:
    """All that the table accepts is accepted and published, once for each set, also one that changes nothing"""
    for one in run.params["sets"]:
        require_accepted(run, one["name"])
        require_once(run, one["name"])


@check(
    points=2,
    on=[START_AT_THE_LIMIT, START_WITH_NAN, START_WITH_AN_INTEGER, NEGATIVE_START],
    needs=[refuses_a_bad_start, refuses_integers, refuses_the_limit_itself],
    see=FROM_THE_START,
    clauses=[13],
)
def refuses_every_bad_start(*runs: Transcript) -> None:
    """Started with 51.0, NaN, an integer or a negative gain, it ends with status 1 and a line"""
    for run in runs:
        require_bad_start_refused(run)


@check(points=1, on=ANY_PUSH, needs=[survives_a_push, publishes_any_gains], see=PUSHED, clauses=[14])
def survives_any_push(run: Transcript) -> None:
    """With other gains, and from any side, the robot survives a push of 10 N·s"""
    require_accepted(run, "new gains")
    require_published(run, "new gains")
    require_standing_after_push(run)


@check(
    points=1,
    on=OTHER_NAMESPACE,
    needs=publishes_what_it_accepted,
    see="01_robot_and_graph#names-why",
    clauses=[15],
)
def works_in_any_namespace(run: Transcript) -> None:
    """Started in another namespace, it publishes there"""
    require_accepted(run, "one gain")
    require_published(run, "one gain")
