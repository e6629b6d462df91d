"""The checks that students can see and run themselves."""

from __future__ import annotations

import math
from functools import partial

from autograder.authoring import RESTING, Scenario, check_of, standard
from autograder.authoring.walking import server_checks
from autograder.authoring.walking.server_checks import INTERRUPT, WRONG_POSES, in_order

from . import model

WALK = server_checks.two_walks(0.2, 0.03)
IMPOSSIBLE = in_order(
    *WRONG_POSES,
    ["ask", "zero quaternion", "pose.orientation.w", 0.0],
    ["ask", "negative velocity", "max_velocity", -0.2],
    ["ask", "NaN velocity", "max_velocity", math.nan],
    robot=RESTING,
)
# This simulated robot always stands, so a server that tests robot_state for WALKING would accept a second goal.
UNREADY = Scenario(
    "beside_a_played_robot",
    {
        "steps": [
            *(["play", False, True], ["go", "before odom", 1.0, 0.0, 0.0]),
            *(["play", True, False], ["go", "without power", 1.0, 0.0, 0.0]),
            *(["play", True, True], ["go", "with odom and power", 1.0, 0.0, 0.0]),
            ["go", "while it stands", 0.0, 1.0, 0.0],
        ]
    },
    robot=None,
)
INTERFERE = in_order(
    *(["go", "walk", 2.0, 0.0, 0.0], ["go", "at once", 0.0, 0.5, 0.0], ["walk_for", 0.5], ["cancel", "walk"]),
    *(["go", "second", 0.0, 0.5, 0.0], ["wait", 2.0], ["interrupt"]),
)
FALL = in_order(
    *(["go", "walk", 2.0, 0.0, 0.0, 0.3], ["walk_for", 0.5], ["knock_over", 0.0, 60.0, 0.0]),
    *(["end", "walk"], ["wait", 1.5], ["go", "lying", 1.0, 0.0, 0.0]),
)

REJECT = "06_walk_to_a_pose#reject-task"
FRAMES = "01_robot_and_graph#frames-intro"

server_appears = standard.server_appears(
    "the action walk_to", on=INTERRUPT, clauses=[13], see="06_walk_to_a_pose#small-intro"
)
accepts_a_goal = check_of(
    model.accepts, title="It accepts a pose in frame odom", on=FALL, needs=server_appears, see=REJECT
)
of_the_impossible = partial(check_of, on=IMPOSSIBLE, needs=accepts_a_goal, see=REJECT)
rejects_a_wrong_frame, rejects_nan = server_checks.rejections(
    model, on=IMPOSSIBLE, needs=accepts_a_goal, see=REJECT
)
rejects_what_is_no_rotation = of_the_impossible(model.rejects_no_rotation)
rejects_a_senseless_velocity = of_the_impossible(
    model.rejects_velocities, title="It rejects a max_velocity that is negative or NaN"
)
rejects_before_the_first_odom = check_of(
    model.rejects_before_odom, on=UNREADY, needs=accepts_a_goal, see=REJECT
)
rejects_without_power = check_of(
    [model.rejects_without_power, model.accepts_unless_busy],
    title="It rejects a goal while the motors are off, at any time, and accepts it when they are on",
    on=[UNREADY, FALL],
    needs=accepts_a_goal,
    see=REJECT,
)
refuses_a_cancel = check_of(model.refuses_cancels, on=INTERFERE, needs=accepts_a_goal)
rejects_a_second_goal = check_of(
    [model.rejects_while_busy, model.goes_on],
    title="It rejects a second goal while the first is active, and the first goes on",
    on=[INTERFERE, UNREADY],
    needs=refuses_a_cancel,
    see="06_walk_to_a_pose#small-intro",
)
of_a_walk = partial(check_of, on=WALK)
walks_to_the_goal = of_a_walk([model.comes_near, model.turns_the_short_way], points=2, needs=accepts_a_goal)
obeys_max_velocity = of_a_walk(model.obeys_max_velocity, needs=walks_to_the_goal)
chooses_its_own_velocity = check_of(model.walks_at_its_own_velocity, on=INTERFERE, needs=accepts_a_goal)
arrives = of_a_walk(model.succeeds, points=2, needs=walks_to_the_goal)
at_the_end = partial(check_of, on=WALK, needs=arrives, see="06_walk_to_a_pose#touch-why")
ends_with_a_zero_twist = at_the_end([model.ends_with_a_zero_twist, model.does_not_steer_without_a_goal])
stands_when_it_succeeds = at_the_end([model.stands_at_success, model.stands_without_a_goal])
fills_the_result, feedback_keeps_its_rate, feedback_is_true, feedback_ends_with_the_goal = (
    server_checks.reports(
        model,
        on=WALK,
        under_way=walks_to_the_goal,
        arrives=arrives,
    )
)
aborts_when_the_robot_falls = server_checks.fall_is_reported(model, on=FALL, needs=walks_to_the_goal)
ends_cleanly = standard.ends_cleanly(
    clauses=[13], on=[INTERRUPT, INTERFERE], needs=server_appears, see="01_robot_and_graph#listen-intro"
)
