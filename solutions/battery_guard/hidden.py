"""The hidden checks, which only the instructor's grading runs."""

from __future__ import annotations

import math
from functools import partial
from random import Random
from typing import Any

from action_msgs.msg import GoalStatus

from autograder.authoring import Scenario, check_of, program
from autograder.authoring.walking.client_scenarios import way

from . import checks, model
from .checks import ON_AND_ON, UNDER_WAY, WALKS, Server, guard, levels, script

INVALID_LEVELS = (math.nan, 20.0, 1.001, -0.3, math.inf, 100.0)
ENDS = (GoalStatus.STATUS_SUCCEEDED, GoalStatus.STATUS_ABORTED)
INEFFECTIVE_CANCELS: tuple[Server, ...] = ({"ends_after": None}, {"agreed": False}, {"agreed": None})
REASON = "a chair stood in the way"


def _between(random: Random, least: float, most: float) -> float:
    return round(random.uniform(least, most), 3)


def _low(random: Random) -> float:
    return round(random.uniform(0.02, 0.19), 3)


def _any_walk(random: Random, arguments: int = 3) -> Server:
    """Draw a pose with a negative x, and battery levels that are never low."""
    pose = [_between(random, -3.0, -0.3), _between(random, 0.3, 3.0), _between(random, -3.0, 3.0)]
    steps = [*UNDER_WAY, *levels(*(_between(random, 0.21, 1.0) for _ in range(4)))]
    return script(checks.ARRIVES, *steps, battery=1.0, arguments=[*map(str, pose[:arguments])])


def _any_story(random: Random) -> Server:
    """Draw invalid levels, then any levels, and any end: the goal's own, a low battery or Ctrl-C, with any response."""
    first = random.sample(INVALID_LEVELS, 3)
    high = (*INVALID_LEVELS, 0.2, *(_between(random, 0.2, 1.0) for _ in range(6)))
    offer = random.choice(([], [["wait", _between(random, 0.2, 0.8)], ["offer"]]))
    steps: list[Any] = [
        *(*levels(*first[1:]), ["wait", _between(random, 0.0, 0.6)], ["battery", high[-1]], *offer),
        *(*WALKS, *levels(*random.choices(high, k=4))),
    ]
    server = {**ON_AND_ON, "after": _between(random, 0.0, 2.5), "error_msg": REASON}
    what = random.choice(("ends", "silence", "low", "low", "Ctrl-C"))
    if what == "ends":
        server |= {"ends_after": 3.0, "status": random.choice((*ENDS, GoalStatus.STATUS_CANCELED))}
    elif what == "silence":
        server |= {"distances": way(random.randrange(12))}
    else:
        server |= random.choice(
            [
                {"cancel": {"ends_after": _between(random, 0.3, 3.5)}},
                {
                    "ends_after": 5.2,
                    "status": random.choice(ENDS),
                    "cancel": random.choice(INEFFECTIVE_CANCELS),
                },
            ]
        )
        why: list[Any] = (
            ["press_ctrl_c"] if what == "Ctrl-C" else ["battery", random.choice((_low(random), 0.0))]
        )
        steps += [why, ["await_cancel"], *levels(random.choice(INVALID_LEVELS), 0.6, 0.1, 0.5)]
        steps += [["wait", _between(random, 0.0, 2.0)], checks.STANDS]
    return script(server, *steps, battery=first[0])


def _dropping(**server: Any) -> Scenario:
    """Return a scenario in which the battery gets low on the way while the robot already stands."""
    return program(
        "in_order",
        lambda random: script({**ON_AND_ON, **server}, *UNDER_WAY, ["wait", 0.8], ["battery", _low(random)]),
    )


def _before_acceptance(random: Random) -> Server:
    server = {**ON_AND_ON, "after": 2.0}
    return script(server, ["await_goal"], ["wait", 0.5], ["battery", _low(random)])


def _late_server(random: Random) -> Server:
    return script(checks.ARRIVES, ["wait", 0.6], ["battery", _low(random)], ["wait", 0.6], ["offer"])


def _silent(random: Random) -> Server:
    """Draw a server that stops sending feedback, while battery_state and robot_state go on."""
    news = [step for level in (0.8, 0.7, 0.6) for step in (["wait", 1.5], ["battery", level], checks.WALKING)]
    return script({"distances": way(random.randrange(8)), "ends_after": None}, *WALKS, *news)


def _ctrl_c_in_vain(random: Random) -> Server:
    end = {"ends_after": 4.2, "status": random.choice(ENDS), "error_msg": REASON}
    server = {**ON_AND_ON, **end, "cancel": {"agreed": False}}
    return script(server, *UNDER_WAY, ["wait", _between(random, 0.0, 0.8)], ["press_ctrl_c"])


def _agreed(ends_after: float | None) -> Server:
    """Return a server whose goal is active until it is cancelled, and ends `ends_after` s later (None: never)."""
    return {**ON_AND_ON, "cancel": {"ends_after": ends_after}}


OTHER_NAMESPACE = program("in_order", _any_walk, namespace="/lab_7/robot")
WITHOUT_YAW = program("in_order", lambda random: _any_walk(random, arguments=2))
AT_THE_LIMIT = guard(checks.ARRIVES, *UNDER_WAY, *levels(0.23, 0.2, 0.2001), battery=0.2)
RARE_FEEDBACK: Server = {"distances": way(2), "every": [0.4, 4.2]}  # s: the battery gets low in between
JUST_BELOW = guard(
    {**_agreed(0.4), **RARE_FEEDBACK},
    *WALKS,
    *levels(0.2, 0.31, 0.2001, 0.31, 0.1999, apart=0.1),
    *checks.stops_after_cancel(stands_after=0.9),
)
STANDS_FIRST = guard(_agreed(2.5), *WALKS, ["battery", 0.0], *checks.stops_after_cancel(stands_after=0.5))
BEFORE_ACCEPTANCE = program("in_order", _before_acceptance)
SUCCEEDS = _dropping(ends_after=4.2, cancel={"ends_after": None})
TOO_LATE = _dropping(ends_after=0.8, result_after=2.5, status=GoalStatus.STATUS_ABORTED, error_msg=REASON)
REFUSED = _dropping(ends_after=4.2, cancel={"agreed": False})
CTRL_C_IN_VAIN = program("in_order", _ctrl_c_in_vain)
LATE_SERVER = program("in_order", _late_server)
NEVER_A_PERCENTAGE = guard({}, *levels(1.001, 20.0, math.nan), battery=1.001, again=False)
ANY_STORY = program("in_order", _any_story)
NEVER_ANSWERED = guard(
    {**ON_AND_ON, "cancel": {"agreed": None}},
    *WALKS,
    ["battery", 0.1],
    *checks.stops_after_cancel(stands_after=0.5),
)
NEVER_STANDS = guard(_agreed(0.5), *WALKS, ["battery", 0.1], *checks.stops_after_cancel(stands_after=None))
NEVER_CANCELED = guard(_agreed(None), *UNDER_WAY, ["press_ctrl_c"])
UNANSWERED = guard({"accepted": None})
SILENT = program("in_order", _silent)
BY_ANOTHER = guard({"distances": way(5), "ends_after": 1.0, "status": GoalStatus.STATUS_CANCELED})

once_it_cancels = partial(check_of, needs=checks.cancels_when_the_battery_drops)
once_it_waits = partial(check_of, needs=checks.waits_until_the_robot_stands, see="08_navigation#standing-why")

goes_anywhere = check_of(
    [model.sends_one_goal, model.compares_exactly, model.ends_with_the_goal],
    title="It works with negative numbers, without a yaw, with a battery at 1.0 and in another namespace",
    on=[OTHER_NAMESPACE, WITHOUT_YAW],
    needs=checks.says_how_it_succeeded,
    see="01_robot_and_graph#names-why",
)
compares_with_the_limit_exactly = once_it_cancels(
    model.compares_exactly,
    title="It does not cancel at 0.20 (as a float32), but does at 0.1999 and 0.0",
    points=2,
    on=[AT_THE_LIMIT, JUST_BELOW, STANDS_FIRST],
    see="08_navigation#float-why",
)
cancels_right_after_the_acceptance = once_it_cancels(
    model.cancels_when_accepted,
    title="If the battery gets low before the goal is accepted, the goal is cancelled right after its acceptance",
    on=BEFORE_ACCEPTANCE,
    see="08_navigation#client-intro",
)
success_wins_the_race = once_it_cancels(
    model.believes_the_end,
    title="If a goal ends SUCCEEDED or ABORTED in spite of the cancel, it exits with status 0 or 3",
    points=2,
    on=[SUCCEEDS, TOO_LATE, CTRL_C_IN_VAIN],
    see="07_cancel_and_preempt#late-why",
)
looks_at_the_battery_until_it_sends = check_of(
    [model.sends_it_only_when_it_may, model.says_that_the_battery_is_low],
    title="If the battery gets low while it waits for the server, it sends no goal",
    on=LATE_SERVER,
    needs=checks.does_not_set_out_on_a_low_battery,
)
waits_for_a_percentage = check_of(
    model.holds_whatever_happens,
    title="While battery_state has no valid percentage, it waits at most 5 s, then exits with status 1",
    on=[NEVER_A_PERCENTAGE, ANY_STORY],
    needs=[checks.ignores_what_is_no_percentage, checks.does_not_set_out_without_a_battery_state],
)
takes_standing_and_canceled_in_any_order = once_it_waits(
    model.waits_for_canceled_and_standing,
    title="If the robot already stands when the goal is CANCELED, it exits at once",
    on=[STANDS_FIRST, BEFORE_ACCEPTANCE],
)
waits_no_longer_than_5_s = once_it_waits(
    model.waits_5_s_for_each,
    title="If CANCELED or STANDING does not come within 5 s, it exits with status 4",
    on=[NEVER_ANSWERED, NEVER_STANDS, NEVER_CANCELED],
    needs=[checks.waits_until_the_robot_stands, checks.ctrl_c_cancels_the_goal],
)
gives_up_in_silence = check_of(
    [model.ends_in_silence, model.says_why],
    title="After 5 s without a response, feedback or result it cancels an accepted goal and exits with status 1",
    on=[UNANSWERED, SILENT],
    needs=checks.gives_up_without_a_server,
    see="03_clients_that_survive#fix-why",
)
tells_a_cancel_by_another = check_of(
    model.ends_with_the_goal,
    title="If another client cancels the goal, it exits with status 4, and a line on stdout says CANCELED",
    on=BY_ANOTHER,
    needs=[checks.says_how_it_failed, checks.ctrl_c_cancels_the_goal],
    see="08_navigation#stop-why",
)
a_refused_cancel_is_no_end = once_it_cancels(
    model.believes_the_end,
    title="If the cancel is rejected (empty goals_canceling), it waits for the result: status 0 after SUCCEEDED",
    on=REFUSED,
    see="07_cancel_and_preempt#m1-why",
)
