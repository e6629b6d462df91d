"""The hidden checks, which only the instructor's grading runs."""

from __future__ import annotations

from collections.abc import Callable
from random import Random
from typing import Any

from autograder.authoring import NOT_FINITE, Scenario, check_of, rounded
from autograder.classroom.hidden_checks import standard_hidden

from . import checks, model
from .checks import AFTERWARDS, HERE, TABLE

INVALID_NAMES = ("tea pot", "", "cup/", "7cups", "tasse-1")  # not allowed in the name of a topic


def _near(random: Random) -> list[float]:
    """Draw a place on the table near the body."""
    return [random.uniform(0.335, 0.365), random.uniform(-0.15, -0.12)]


def _aside(random: Random) -> list[float]:
    """Draw a place farther to the right, at least 8 cm from any of `_near`."""
    return [random.uniform(0.335, 0.365), random.uniform(-0.27, -0.23)]


def _fetching(random: Random) -> list[Any]:
    """Send goals for unknown objects and impossible goals, then fetch the cup twice, firmly and gently."""
    first, second = random.sample((_near, _aside), 2)
    wrong: list[list[Any]] = [
        ["go", "no frame of ours", HERE, 10.0, "cup", random.choice(("map", "base_link", "", "ODOM"))],
        [
            "go",
            "not finite",
            random.choice(([random.choice(NOT_FINITE), -0.25], [0.33, random.choice(NOT_FINITE)])),
        ],
        ["go", "no force", HERE, random.choice((-0.1, 0.0, 25.5, *NOT_FINITE))],
        ["go", "no name", HERE, 10.0, random.choice(INVALID_NAMES)],
        ["go", "unknown", HERE, 10.0, random.choice(("teapot", "cups"))],
    ]
    random.shuffle(wrong)
    asked = [step for go in wrong for step in (go, ["arrive", go[1]])]
    return [
        *asked,
        ["put_cup", *first(random)],
        *(["go", "firm", second(random), random.uniform(13.0, 16.0)], ["arrive", "firm"]),
        *(
            ["wait", AFTERWARDS],
            ["go", "gentle", first(random), random.uniform(5.0, 6.5)],
            ["arrive", "gentle"],
        ),
    ]


def _starting_over(random: Random) -> list[Any]:
    """Cancel while the fingers close, move the cup elsewhere, then fetch it."""
    return [
        *(["put_cup", *_near(random)], ["go", "canceled", _aside(random)], ["wait_until", "touching"]),
        *(["cancel", "canceled"], ["arrive", "canceled"], ["wait", AFTERWARDS]),
        *(["put_cup", *_aside(random)], ["go", "fetch", _near(random)], ["arrive", "fetch"]),
    ]


def _on_the_way(random: Random) -> list[Any]:
    """Cancel one goal late on its way, and take the cup away halfway through another."""
    near, aside = [0.32, -0.10], [0.34, -0.28]
    return [
        *(["put_cup", *near], ["go", "late", aside, random.uniform(9.0, 11.0)]),
        *(
            ["wait_until", "carried", "late", random.uniform(0.7, 0.85)],
            ["cancel", "late"],
            ["arrive", "late"],
        ),
        *(["wait", AFTERWARDS], ["put_cup", *near], ["go", "lost", aside, random.uniform(9.0, 11.0)]),
        *(["take_when", "carried", "lost", random.uniform(0.4, 0.55)], ["arrive", "lost"]),
    ]


def _drawn(steps: Callable[[Random], list[Any]]) -> Scenario:
    return Scenario(
        "in_order", lambda random: {"steps": rounded([*steps(random), ["wait", AFTERWARDS]])}, robot=TABLE
    )


FETCHING, STARTING_OVER, ON_THE_WAY = map(_drawn, (_fetching, _starting_over, _on_the_way))
OTHER_NAMESPACE = checks.at_the_table(
    ["go", "fetch", [0.35, -0.25]], ["arrive", "fetch"], namespace="/lab_7/robot"
)

EVERY_GOAL = (  # what holds for a goal however it ends
    model.accepts,
    model.puts_down,
    model.names_stages,
    model.true_stages,
    model.feedback_at_5_hz,
    model.no_late_feedback,
    model.measured,
    model.percentage,
    model.keeps_order,
)

fetches_from_anywhere = check_of(
    [
        model.rejects_frames,
        model.rejects_not_finite,
        model.rejects_forces,
        *EVERY_GOAL,
        model.places,
        model.lifts,
        model.filled_result,
    ],
    title="It fetches the cup from any place to any place_pose, and fulfils every clause meanwhile",
    points=2,
    on=FETCHING,
    needs=checks.places_the_cup,
    see="09_arms#careful-why",
)
obeys_any_force = check_of(
    [model.places, model.keeps_force],
    title="It holds the cup with the grasp_force of the goal, firm or gentle",
    points=2,
    on=FETCHING,
    needs=[checks.keeps_the_force, fetches_from_anywhere],
    see="09_arms#force-why",
)
fetches_twice = check_of(
    [model.accepts, model.places_again],
    title="After one goal it carries out another",
    on=FETCHING,
    needs=checks.places_the_cup,
    see="09_arms#careful-why",
)
survives_a_name_that_is_none = check_of(
    [model.unknown_objects, model.says_why_it_aborted],
    title="An object_id that cannot be part of a topic's name also ends with UNKNOWN_OBJECT",
    on=FETCHING,
    needs=checks.knows_no_teapot,
)
notices_a_loss_on_the_way = check_of(
    [model.lost_object, model.says_why_it_aborted],
    title="When the cup is lost while it is moved across, the goal ends with DROPPED",
    on=ON_THE_WAY,
    needs=checks.notices_a_lost_cup,
)
cancels_while_closing = check_of(
    [model.leaves_the_cup, model.answers_cancels],
    title="A cancel while the fingers close opens them and leaves the cup where it is",
    on=STARTING_OVER,
    needs=checks.cancels_before_the_grasp,
    see="09_arms#lift-why",
)
puts_the_cup_at_the_nearer_place = check_of(
    [model.puts_away, *EVERY_GOAL, model.keeps_force],
    title="After a cancel shortly before arrival, the cup is put at place_pose, then the goal ends CANCELED",
    points=2,
    on=ON_THE_WAY,
    needs=checks.puts_the_cup_back,
    see="09_arms#put-down-gap",
)
fetches_after_a_cancel = check_of(
    [model.accepts, model.places_after_a_cancel],
    title="After a cancel it carries out another goal",
    on=STARTING_OVER,
    needs=[checks.cancels_before_the_grasp, checks.places_the_cup],
    see="07_cancel_and_preempt#fix-intro",
)
works_in_any_namespace = standard_hidden.works_in_any_namespace(
    "fetches the cup", model.places, clauses=[21], on=OTHER_NAMESPACE, needs=checks.places_the_cup
)
