"""The hidden checks, which only the instructor's grading runs."""

from __future__ import annotations

import math
from functools import partial
from random import Random
from typing import Any

from autograder.authoring import Scenario, check_of, rounded, shuffled
from autograder.authoring.walking.server_checks import OTHER_NAMESPACE
from autograder.classroom.hidden_checks import standard_hidden

from . import checks, model
from .checks import FAR, QUIET_TIME, arrive

Steps = list[list[Any]]


def _steps(random: Random) -> dict[str, Any]:
    """Walk to two poses, one ahead with a small tolerance, one behind it with a large tolerance.

    Then, in random order, goals are cancelled early, while the robot turns, while it walks and shortly before arrival,
    are preempted, or equal the present pose. At the end the motor power is cut.
    """
    side = random.choice((-1, 1))
    x, y = random.uniform(0.6, 1.0), side * random.uniform(0.4, 0.8)
    angle = random.uniform(-0.05, 0.05)  # rad; on the way back the heading is near the jump from pi to -pi
    behind_it = [-1.5, side * 0.5, 0.0]
    behind = (x - 0.9 * math.cos(angle), y - 0.9 * math.sin(angle), random.uniform(-math.pi, math.pi))

    def canceled(name: str, pose: list[float], *wait: Any) -> Steps:
        return [
            ["go_on", name, *pose],
            *wait,
            ["cancel", name],
            ["end", name],
            ["wait", checks.STOP_AND_STAY_TIME],
        ]

    blocks: list[Steps] = [
        canceled("early", FAR),
        canceled("turning", behind_it, ["walk_for", random.uniform(0.3, 1.5)]),
        canceled("walking", FAR, ["walk_for", random.uniform(1.0, 3.0)]),
        canceled("near", [0.6, 0.0, 0.0], ["come_near", "near", 0.2]),
        [
            *(["go_on", "old", *FAR], ["walk_for", random.uniform(1.5, 2.5)]),
            ["ask", "in a frame", "header.frame_id", random.choice(("map", "base_link", "world", ""))],
            *(["go_on", "new", *FAR], ["end", "old"], ["walk_for", random.uniform(0.2, 0.5)]),
            ["go_on", "newest", random.uniform(0.5, 0.8), random.choice((-0.5, 0.5)), random.uniform(-1, 1)],
            *(["end", "new"], arrive("newest", 1.0), ["wait", QUIET_TIME]),
        ],
        [["go_on", "here", 0.0, 0.0, 0.0], ["end", "here"], ["wait", QUIET_TIME]],
        [
            ["go_on", "turn", 0.0, 0.0, side * random.uniform(0.8, 1.2)],
            arrive("turn", 0.0),
            ["wait", QUIET_TIME],
        ],
    ]
    any_order = shuffled(random, blocks)
    steps = [
        *(["go", "first", x, y, math.atan2(y, x), random.uniform(0.06, 0.08)], arrive("first", 1.0)),
        *(["wait", QUIET_TIME], ["go", "second", *behind, random.uniform(0.15, 0.25)], arrive("second", 1.0)),
        *(["wait", QUIET_TIME], *any_order),
        *(["go_on", "down", *random.choice((FAR, behind_it))], ["walk_for", random.uniform(0.3, 1.0)]),
        *(["cut_power"], ["end", "down"], ["wait", QUIET_TIME], ["go", "lying", 0.0, 0.0, 0.0]),
    ]
    return {"steps": rounded(steps)}


def _to_the_other_side(random: Random) -> dict[str, Any]:
    steps = [
        *(["go", "go", 1.8, random.uniform(-0.2, 0.2), 0.0], ["get_away", 0.9]),
        *(["lead_astray", random.uniform(3.5, 4.5), -1], arrive("go", 1.8), ["wait", QUIET_TIME]),
    ]
    return {"steps": rounded(steps)}


ANY_ORDER = Scenario("in_order", _steps)
TO_THE_OTHER_SIDE = Scenario("in_order", _to_the_other_side)

in_any_order = partial(check_of, on=ANY_ORDER)
arrives_within_the_tolerance = in_any_order(
    [
        model.accepts,
        model.rejects_frames,
        model.rejects_without_power,
        model.goes_on,
        model.succeeds,
        model.stands_at_success,
        model.stands_without_a_goal,
        model.status_in_order,
        model.succeeds_where_it_stands,
        model.feedback_at_5_hz,
        model.feedback_ends_with_the_goal,
        model.feedback_is_true,
        model.gives_way,
        model.tells_a_fall,
        model.names_no_error,
        model.says_why_it_aborted,
    ],
    title="It reaches several poses with any heading, each within its tolerance, and fulfils every clause",
    points=2,
    needs=checks.arrives,
    see="06_walk_to_a_pose#settle-why",
)
tells_each_goal_its_own_story = in_any_order(
    [model.measures_its_path, model.counts_no_recovery, model.progress_rises],
    title="distance_traveled, number_of_recoveries and progress_percentage start at 0 for each goal",
    needs=[arrives_within_the_tolerance, checks.measures_its_path, checks.counts_no_detour_without_one],
)
cancels_in_any_phase = in_any_order(
    [model.grants_cancels, model.stops_when_canceled],
    title="A cancel before the first step or during a turn also ends CANCELED, with the robot still",
    needs=checks.cancels_in_mid_stride,
)
gets_back_from_anywhere = check_of(
    [
        model.counts_the_detour,
        model.finds_its_way_back,
        model.feedback_at_5_hz,
        model.feedback_is_true,
        model.measures_its_path,
    ],
    title="A detour to the other side is counted, too, and the robot arrives",
    on=TO_THE_OTHER_SIDE,
    needs=checks.counts_the_recovery,
    see="08_navigation#loops-why",
)
a_new_goal_has_a_time_of_its_own = in_any_order(
    [model.succeeds, model.tells_its_time],
    title="navigation_time counts from the acceptance of each goal, also after a cancel",
    needs=[checks.new_goal_preempts_the_old, checks.tells_its_time],
    see="08_navigation#conventions",
)
works_in_any_namespace = standard_hidden.works_in_any_namespace(
    "walks the robot", model.succeeds, clauses=[21], on=OTHER_NAMESPACE, needs=checks.arrives
)
