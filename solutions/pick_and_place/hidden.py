"""What only the instructor's grading checks."""

from __future__ import annotations

from autograder.authoring.checks import RESTING, Scenario, check
from autograder.authoring.transcript import Transcript
from autograder.classroom.hidden_checks.standard_hidden import (
    works_in_any_namespace as _works_in_any_namespace,
)

from .checks import (
    TABLE,
    cancels_before_the_grasp,
    keeps_the_force,
    knows_no_teapot,
    notices_a_lost_cup,
    places_the_cup,
    puts_the_cup_back,
)
from .endings import require_aborted
from .holding import require_force_kept
from .placing import require_placed
from .safe_ends import require_dropped, require_left_alone, require_put_away
from .truth import place_of


def _anywhere(random) -> dict:
    """A cup and a place within easy reach, 8 cm apart at least, and a force."""
    near, far = random.uniform(-0.15, -0.12), random.uniform(-0.27, -0.23)
    first, second = random.sample((near, far), 2)
    return {
        "cup": [round(random.uniform(0.335, 0.365), 3), round(first, 3)],
        "place": [round(random.uniform(0.335, 0.365), 3), round(second, 3)],
        "force": round(random.uniform(13.0, 16.0), 1),
    }


def _gently(random) -> dict:
    return {"place": [0.34, -0.26], "force": round(random.uniform(5.0, 6.5), 1)}


def _twice(random) -> dict:
    """Two places, one after the other."""
    return {
        "places": [
            [round(random.uniform(0.335, 0.365), 3), round(random.uniform(*span), 3)]
            for span in ((-0.28, -0.24), (-0.15, -0.11))
        ],
        "force": 10.0,
    }


def _late(random) -> dict:
    """A cancel when most of the way is over."""
    return {"cup": [0.32, -0.10], "place": [0.34, -0.28], "way": round(random.uniform(0.7, 0.85), 2)}


ANYWHERE = Scenario("fetch", _anywhere, robot=TABLE)
GENTLY = Scenario("fetch", _gently, robot=TABLE)
TWICE = Scenario("fetch_twice", _twice, robot=TABLE)
NO_NAMES = Scenario("ask_for_the_unknown", {"objects": ["tea pot", "", "teapot"]}, robot=RESTING)
ON_THE_WAY = Scenario("snatch", {"way": 0.5}, robot=TABLE)
CLOSING = Scenario("cancel_before_the_grasp", {"closing": True}, robot=TABLE)
LATE = Scenario("cancel_while_holding", _late, robot=TABLE)
AGAIN = Scenario("cancel_and_fetch_again", {"place": [0.35, -0.25], "force": 10.0}, robot=TABLE)
OTHER_NAMESPACE = Scenario(
    "fetch", {"place": [0.35, -0.25], "force": 10.0}, robot=TABLE, namespace="/lab_7/robot"
)

LOOK = "07_cancel_and_preempt#conventions"


@check(points=2, on=ANYWHERE, needs=places_the_cup, see="09_arms#careful-why", clauses=[2, 3, 4])
def fetches_from_anywhere(run: Transcript) -> None:
    """It finds the cup wherever it stands, and puts it down wherever it has to stand"""
    require_placed(run.goal("fetch"))


@check(
    points=2,
    on=[ANYWHERE, GENTLY],
    needs=[keeps_the_force, fetches_from_anywhere],
    see="09_arms#force-why",
    clauses=[3, 5],
)
def obeys_any_force(anywhere: Transcript, gently: Transcript) -> None:
    """It holds the cup with whatever force is asked for, firm or gentle"""
    for run in (anywhere, gently):
        require_placed(run.goal("fetch"))
        require_force_kept(run.goal("fetch"))


@check(on=TWICE, needs=places_the_cup, see="09_arms#careful-why", clauses=[3])
def fetches_twice(run: Transcript) -> None:
    """After a goal it carries out another"""
    run.goal("fetch 1").require_accepted()
    require_placed(run.goal("fetch 2"))


@check(on=NO_NAMES, needs=knows_no_teapot, see="09_arms#phases-why", clauses=[11, 17])
def survives_a_name_that_is_none(run: Transcript) -> None:
    """An object_id that cannot be part of a topic's name is an unknown object, too"""
    for number, name in enumerate(run.params["objects"], start=1):
        require_aborted(
            run.goal(f"unknown {number}"),
            "UNKNOWN_OBJECT",
            because=f"there is no object {name!r}",
            help="create_subscription() raises InvalidTopicNameException for a name with a space, or an empty one: "
            "catch it, and abort with UNKNOWN_OBJECT.",
        )


@check(on=ON_THE_WAY, needs=notices_a_lost_cup, see="09_arms#slip-why", clauses=[15, 17])
def notices_a_loss_on_the_way(run: Transcript) -> None:
    """When the cup is lost on its way across the goal ends with DROPPED, too"""
    require_dropped(run.goal("fetch"))


@check(on=CLOSING, needs=cancels_before_the_grasp, see="09_arms#lift-why", clauses=[18])
def cancels_while_closing(run: Transcript) -> None:
    """A cancel while the fingers close opens them and leaves the cup where it is"""
    require_left_alone(run.goal("fetch"))


@check(points=2, on=LATE, needs=puts_the_cup_back, see="09_arms#put-down-gap", clauses=[19])
def puts_the_cup_at_the_nearer_place(run: Transcript) -> None:
    """A cancel when the cup is nearly there puts it at place_pose, then ends CANCELED"""
    require_put_away(run.goal("fetch"), place_of(run.goal("fetch")), "place_pose, which is nearer")


@check(
    on=AGAIN,
    needs=[cancels_before_the_grasp, places_the_cup],
    see="07_cancel_and_preempt#fix-intro",
    clauses=[3],
)
def fetches_after_a_cancel(run: Transcript) -> None:
    """After a cancel it carries out another goal"""
    run.goal("canceled").require_canceled()
    require_placed(run.goal("fetch"))


works_in_any_namespace = _works_in_any_namespace(
    "fetches the cup",
    lambda run: require_placed(run.goal("fetch")),
    on=OTHER_NAMESPACE,
    needs=places_the_cup,
    clauses=[21],
)
