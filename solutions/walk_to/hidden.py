"""The hidden checks, which only the instructor's grading runs."""

from __future__ import annotations

import math
from functools import partial
from random import Random
from typing import Any

from autograder.authoring import NOT_FINITE, Scenario, check_of, rounded
from autograder.authoring.walking.server_checks import OTHER_NAMESPACE, impossible
from autograder.classroom.hidden_checks import standard_hidden

from . import checks, model

AFTERWARDS = 0.8  # s from a result to the next goal
QUIET_TIME = 1.5  # s after the last result, in which no more feedback may be published


def _steps(random: Random) -> dict[str, Any]:
    """Turn around, walk slowly along a diagonal, then backwards; send invalid and simultaneous goals; fall.

    On the way to the second pose, a velocity in odom's axes leads in a wrong direction, and a velocity that is limited
    for each axis is 1.4 times too fast. The heading crosses pi there, and the other way on the way backwards. After the
    fall the robot is set up again.
    """
    side = random.choice((-1, 1))
    far = (random.uniform(0.2, 0.3), random.uniform(-0.1, 0.1), side * random.uniform(3.0, 3.1))
    ahead, left = random.uniform(0.36, 0.4), -side * random.uniform(0.36, 0.4)
    x = far[0] + math.cos(far[2]) * ahead - math.sin(far[2]) * left
    y = far[1] + math.sin(far[2]) * ahead + math.cos(far[2]) * left
    yaw = -side * random.uniform(3.0, 3.1)
    back = random.uniform(0.32, 0.36)  # m; long enough to judge the speed
    steps: list[Any] = [
        [random.choice(("go", "cancel_at_once")), "back", *far, random.choice((0.0, 5.0))],
        *(["arrive", "back"], ["wait", AFTERWARDS]),
        ["go", "across pi", x, y, yaw, random.uniform(0.09, 0.1)],
        *random.sample(
            [
                ["cancel", "across pi"],
                ["cancel_twice", "across pi"],
                ["cancel_all"],
                ["go", "meanwhile", 0.0, 0.0, 0.0],
                ["ask", "map meanwhile", "header.frame_id", "map"],
            ],
            3,
        ),
        *(["arrive", "across pi"], ["wait", AFTERWARDS], ["cancel", "across pi"]),
        *(["go", "here", x, y, yaw, random.uniform(0.1, 0.3)], ["arrive", "here"], ["wait", AFTERWARDS]),
        ["go", "backwards", x - back * math.cos(yaw), y - back * math.sin(yaw), -yaw, 0.1],
        *(["arrive", "backwards"], ["wait", AFTERWARDS]),
        [
            "go_together",
            ["one", x, y, -yaw, 0.0],
            ["other", x, y, -yaw, 0.0],
        ],
        *(["arrive", "one"], ["arrive", "other"], ["wait", AFTERWARDS]),
        *impossible(
            random, ("pose.orientation.w", 0.0), ("max_velocity", random.choice((-0.01, -3.0, *NOT_FINITE)))
        ),  # near the end, so that one that is accepted does not disturb other goals
        *(["go", "far", 0.0, 0.0, yaw, 0.3], ["walk_for", round(random.uniform(0.3, 1.0), 2)]),
        *(["cut_power"], ["end", "far"], ["wait", QUIET_TIME], ["go", "lying", 0.0, 0.0, 0.0]),
        *(["set_up"], ["go", "up again", x, y, yaw, 0.2], ["arrive", "up again"]),
    ]
    return {"steps": rounded(steps)}


ANY_ORDER = Scenario("in_order", _steps)

WALKED = (model.accepts, model.succeeds)  # required before its way of walking can be checked

in_any_order = partial(check_of, on=ANY_ORDER, needs=checks.arrives, see=checks.FRAMES)
arrives_anywhere = in_any_order(
    [
        model.accepts,
        model.refuses_cancels,
        model.goes_on,
        model.succeeds,
        model.takes_one_of_several,
        model.status_in_order,
        model.stands_at_success,
        model.stands_without_a_goal,
        model.ends_with_a_zero_twist,
        model.does_not_steer_without_a_goal,
        model.feedback_at_5_hz,
        model.feedback_is_true,
        model.feedback_ends_with_the_goal,
        model.reports_where_it_ended,
        model.tells_a_fall,
        model.says_why_it_aborted,
    ],
    title="It reaches several poses with any heading, with other requests meanwhile, and fulfils every clause",
    points=2,
)
turns_the_shorter_way = in_any_order(
    [*WALKED, model.turns_the_short_way], title=model.turns_the_short_way.sentence
)
obeys_any_max_velocity = in_any_order(
    [*WALKED, model.obeys_max_velocity],
    title="The robot is not faster than max_velocity in any direction",
    needs=[checks.arrives, checks.obeys_max_velocity],
)
rejects_any_other_frame = in_any_order(
    [
        model.rejects_frames,
        model.rejects_nan,
        model.rejects_no_rotation,
        model.rejects_velocities,
        model.rejects_without_power,
    ],
    title="It rejects every frame other than odom, and every invalid pose or velocity",
    needs=checks.rejects_a_wrong_frame,
    see=checks.REJECT,
)
works_in_any_namespace = standard_hidden.works_in_any_namespace(
    "walks the robot",
    model.succeeds,
    clauses=[13],
    on=OTHER_NAMESPACE,
    needs=[checks.arrives, checks.chooses_its_own_velocity],
)
