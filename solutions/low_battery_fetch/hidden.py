"""The hidden checks, which only the instructor's grading runs."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from random import Random
from typing import Any

from autograder.authoring import Scenario, check_of
from autograder.classroom.hidden_checks import standard_hidden

from . import checks, model
from .sequences import CHARGED, LONG_WALK_TIME, Part, cancel, drop, fetch, in_order, levels, preempt, scenario

CANCEL_REPLIES = (
    (True, 0.3),
    (True, 2.0),
    (False, 0.0),
    (None, 0.0),
)  # accepts, rejects, no response; s to the end
REJECTS_CANCEL = (False, 0.0)
ACCEPTED_LATE = {"answered_after": 2.0, "takes": LONG_WALK_TIME}
HOLDING = ("lifting", "moving", "placing", "retreating")
LEVELS = (math.nan, math.inf, 20.0, -0.3, 1.001, 0.2, 0.2001, 0.5, 0.99)


def _cup(random: Random) -> list[Any]:
    place = [random.uniform(0.2, 0.6), random.uniform(-0.4, 0.4), random.uniform(0.4, 0.9)]
    numbers = [*place, random.uniform(5.0, 15.0), random.uniform(-3.0, 3.0)]
    return [random.choice(("mug", "glass", "bottle")), *(round(each, 2) for each in numbers)]


def _low(random: Random) -> float:
    return round(random.uniform(0.0, 0.195), 3)


def _shuffled(parts: Callable[[Random], list[Part]]) -> Scenario:
    def draw(random: Random) -> dict[str, Any]:
        drawn = parts(random)
        random.shuffle(drawn)
        return in_order(*drawn)

    return Scenario("in_order", draw, robot=None)


def _drops(random: Random) -> list[Part]:
    early = fetch("early", ["send", 1], ["wait", 0.5], ["battery", _low(random)])
    return [
        drop("approaching", _low(random), 2, "approaching"),
        drop("grasping", _low(random), 2, "grasping"),
        drop("at the tray", _low(random), 4, random.choice(("approaching", "grasping"))),
        drop("placing", _low(random), 2, "placing"),
        drop("going home", _low(random), 3),
        drop("putting it down", _low(random), 4, random.choice(HOLDING)),
        drop("refused", _low(random), 1, stops=REJECTS_CANCEL),
        drop("recovers", _low(random), 1, "", ["wait", 1.2], ["battery", 0.35], stops=(True, 2.0)),
        Part([*early.steps, ["battery", CHARGED], ["wait", 1.0]], [ACCEPTED_LATE, {}]),
    ]


def _cancels(random: Random) -> list[Part]:
    return [
        cancel("taking", 2, random.choice(HOLDING), stops=(True, 1.5)),
        cancel("putting it down", 4, random.choice(HOLDING)),
        cancel("refused", 1, stops=REJECTS_CANCEL),
        fetch("early", ["send", 1], ["wait", 0.5], ["cancel", "early"], children=[ACCEPTED_LATE]),
    ]


def _failures(random: Random) -> list[Part]:
    unresponsive = {"stages": {"approaching": 60.0}, "silent_after": 0.6, "stops": (None, 0.0)}
    return [
        fetch("no answer", children=[{}, {"accepted": None}]),
        fetch("deaf", children=[{}, unresponsive]),
        fetch("canceled by another", children=[{}, {}, {"ends": "CANCELED"}]),
    ]


def _anything(random: Random) -> dict[str, Any]:
    """Draw fetches with invalid battery levels and long children, and others that end at random steps."""
    fails = {"ends": "ABORTED", "code": random.randint(1, 5), "said": f"reason {random.randint(100, 999)}"}
    empty_handed = random.choice(((1, ""), (2, "approaching"), (2, "grasping")))
    parts = [
        fetch("levels", *levels(*random.sample(LEVELS, 6)), cup=_cup(random)),
        fetch("long", *_impossible(random), cup=_cup(random), children=[{}, {}, {"takes": 8.0}, {}]),
        fetch("fails", cup=_cup(random), children=[*[{}] * random.randint(0, 3), fails]),
        drop("empty", _low(random), *empty_handed, stops=random.choice(CANCEL_REPLIES)),
        drop("low", _low(random), *_moment(random), stops=random.choice(CANCEL_REPLIES)),
        cancel("canceled", *_moment(random), stops=random.choice(CANCEL_REPLIES)),
        preempt("old", "new", *_moment(random), cup=_cup(random), stops=random.choice(CANCEL_REPLIES)),
    ]
    random.shuffle(parts)
    before = fetch("before", children=())
    low = Part([["battery", _low(random)], ["wait", 1.0], *before.steps, ["battery", 0.5], ["wait", 1.0]])
    return in_order(*parts, low, fetch("after it"))


def _moment(random: Random) -> tuple[int, str]:
    """Draw a step of a fetch, and a stage if pick_and_place does that step."""
    step = random.randint(1, 4)
    return step, "" if step % 2 else random.choice(("approaching", "grasping", *HOLDING))


def _impossible(random: Random) -> list[list[Any]]:
    """Return steps with goals that must be rejected, each with one invalid field."""
    numbers = (math.nan, math.inf, -math.inf)
    wrong: list[list[Any]] = [
        ["place_pose.header.frame_id", random.choice(("base_link", "world", ""))],
        *([f"place_pose.pose.position.{axis}", random.choice(numbers)] for axis in "xyz"),
        *([f"place_pose.pose.orientation.{axis}", random.choice(numbers)] for axis in "xyzw"),
        ["grasp_force", random.choice((math.inf, -1.0, 0.0))],
    ]
    return [["ask", f"impossible {number}", *each] for number, each in enumerate(random.sample(wrong, 4))]


ANYTHING = Scenario("in_order", _anything, robot=None)
NO_PERCENTAGE = scenario(
    fetch("fetch", *levels(math.nan, 0.5, 20.0, 0.2, -0.3, 0.2001), children=[{}, {}, {"takes": 8.0}, {}])
)
OTHER_NAMESPACE = scenario(fetch("fetch"), namespace="/lab_7/robot")
CHARGING = Part([["battery", 0.9], ["wait", 1.0]])
LOW_THEN_CHARGED = scenario(fetch("low", children=()), CHARGING, fetch("charged"), battery=0.195)
NO_BATTERY = scenario(
    fetch("nothing", children=()),
    Part([["battery", math.nan], ["battery", 1.5], ["wait", 1.0]]),
    fetch("no percentage", children=()),
    CHARGING,
    fetch("charged"),
    battery=None,
)
DROPS, CANCELS, FAILURES = map(_shuffled, (_drops, _cancels, _failures))
REJECTED = scenario(fetch("rejected", children=[{"accepted": False}]), fetch("again"))
DYING = scenario(
    fetch("the arm", ["reach", 2], ["die", "pick_and_place"], children=[{}, {"stages": {"moving": 60.0}}]),
    fetch("the walk", ["reach", 1], ["die", "navigate_to_pose"], children=[{"takes": 60.0}]),
)
MISSING = scenario(
    Part([["die", "pick_and_place"], ["wait", 1.0]]),
    fetch("nobody grasps", children=[{}]),
    Part([["die", "navigate_to_pose"], ["wait", 1.0]]),
    fetch("nobody walks", children=()),
)

in_drops = partial(check_of, on=DROPS, needs=checks.gives_up_before_the_grasp, see=checks.GIVES_UP)
in_cancels = partial(check_of, on=CANCELS, needs=checks.cancel_goes_down)
of_servers = partial(check_of, see=checks.SILENCE_LESSON)
in_failures = partial(check_of, on=FAILURES, see=checks.SILENCE_LESSON)

fetches_anything = check_of(
    [*model.fetches_it, model.hands_feedback_on, model.reports_the_object, model.keeps_every_clause],
    title="Percentages NaN, 20.0 and -0.3 are ignored, 0.20 is not low, and every clause holds in any situation",
    on=[NO_PERCENTAGE, ANYTHING],
    needs=checks.fetches,
    see=checks.BATTERY_LESSON,
)
sends_nobody_without_a_battery = check_of(
    [model.does_nothing_when_unknown, model.serves_again],
    title="Before the first battery_state fetch is ABORTED naming the battery; after it, a goal is carried out",
    on=NO_BATTERY,
    needs=[checks.fetches, checks.does_not_set_out_on_a_low_battery],
    see=checks.BATTERY_LESSON,
)
sets_out_when_it_is_charged = check_of(
    model.serves_again,
    title="After the battery was low and is charged again, the next goal is carried out",
    on=LOW_THEN_CHARGED,
    needs=[checks.fetches, checks.does_not_set_out_on_a_low_battery],
)
gives_up_while_the_hand_is_empty = in_drops(
    model.of(("approaching", "grasping"), *model.stops_in_time),
    title="If the battery gets low in the stage 'approaching' or 'grasping', pick_and_place is canceled, too",
    points=2,
)
gives_up_at_home = in_drops(
    model.of(("at the tray",), *model.always, model.stops_with_empty_hands, model.gives_up_when_home),
    title="If the battery gets low at home before the grasp, the child is canceled, and fetch is ABORTED there",
    needs=[checks.fetches, checks.gives_up_before_the_grasp],
)
finishes_placing_to_the_end = in_drops(
    model.of(("placing",), *model.finishes_first),
    title="If the battery gets low in the stage 'placing', pick_and_place is finished before the robot goes home",
    needs=checks.finishes_placing_first,
)
carries_it_home = in_drops(
    model.of(("going home",), *model.always, model.lets_it_finish, model.gives_up_when_home),
    title="If the battery gets low on the way home, the robot goes on; then fetch is ABORTED, the object on the tray",
    needs=[checks.fetches, checks.gives_up_before_the_grasp],
)
success_wins = in_drops(
    model.of(("putting it down",), *model.always, model.lets_it_finish, model.ends_well),
    title="If the battery gets low while the object is put down at home, that is finished, and fetch SUCCEEDS",
    needs=[checks.fetches, finishes_placing_to_the_end],
    see="07_cancel_and_preempt#late-why",
)
waits_for_a_child_that_goes_on = in_drops(
    [*model.of(("refused",), *model.stops_in_time), model.one_child_at_a_time],
    title="If the child rejects the cancel, fetch waits until it has ended; then the robot goes home",
    see=checks.GOES_DOWN,
)
gives_up_for_good = in_drops(
    model.of(("recovers",), *model.stops_in_time),
    title="If the battery is charged again while the child stops, the robot still goes home, and fetch is ABORTED",
    see=checks.BATTERY_LESSON,
)
gives_up_right_after_the_acceptance = in_drops(
    model.of(("early",), *model.stops_in_time),
    title="If the battery gets low before the child is accepted, the child is canceled right after its acceptance",
    see="08_navigation#client-intro",
)
cancel_goes_down_to_the_arm = in_cancels(
    model.of(("taking", "putting it down"), *model.obeys_a_cancel),
    title="A cancel of fetch also cancels an active pick_and_place, which puts the object down by itself",
    points=2,
    needs=[checks.fetches, checks.cancel_goes_down],
)
waits_although_the_cancel_is_refused = in_cancels(
    [*model.of(("refused",), *model.obeys_a_cancel), model.one_child_at_a_time],
    title="If the child rejects the cancel, fetch is CANCELED only when the child has ended by itself",
    points=2,
    see=checks.ORPHANS,
)
remembers_a_cancel = in_cancels(
    model.of(("early",), *model.obeys_a_cancel),
    title="After a cancel before the child is accepted, the child is canceled right after its acceptance",
    see="07_cancel_and_preempt#late-why",
)
gives_up_without_an_answer = in_failures(
    model.of(("no answer",), model.gives_up_the_unanswered),
    needs=[checks.says_why_a_child_failed, checks.cancels_a_late_child],
)
survives_a_dying_server = of_servers(
    model.gives_up_the_silent,
    title="When a child's server dies, fetch ends ABORTED naming the action, and the node goes on running",
    points=2,
    on=DYING,
    needs=[checks.cancels_a_silent_child, checks.fetches],
)
waits_no_longer_than_it_must = in_failures(
    model.of(("deaf",), *model.always, model.cancels_the_silent, model.gives_up_the_silent),
    title="If a child without feedback does not respond to the cancel, fetch is ABORTED 5 s later, naming the action",
    needs=[checks.cancels_a_silent_child, checks.fetches],
)
gives_up_without_a_server = of_servers(
    model.gives_up_the_missing, on=MISSING, needs=checks.says_why_a_child_failed
)
fails_when_another_cancels_the_child = in_failures(
    model.of(("canceled by another",), model.says_who_failed),
    title="If another client cancels the child, the child has failed: fetch is ABORTED, not CANCELED",
    needs=checks.says_why_a_child_failed,
    see=checks.ORPHANS,
)
serves_the_next_goal = check_of(
    model.serves_again,
    on=REJECTED,
    needs=[checks.fetches, checks.says_why_a_child_failed],
    see=checks.ORPHANS,
)
works_in_any_namespace = standard_hidden.works_in_any_namespace(
    "fetches", model.ends_well, on=OTHER_NAMESPACE, needs=checks.fetches, clauses=[31]
)
