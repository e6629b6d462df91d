"""The checks that students can see and run themselves."""

from __future__ import annotations

import math
from functools import partial
from typing import Any

from autograder.authoring import RESTING, check_of, standard
from autograder.authoring.walking.server_checks import INTERRUPT, WRONG_POSES, in_order

from . import model

FAR = [2.5, 0.0, 0.0]  # m, m, rad
QUIET_TIME = 1.5  # s after a result, in which no more feedback may be published
STOP_AND_STAY_TIME = 3.5  # s after a cancel or the time limit, in which the robot must stop and stay still


def arrive(name: str, distance: float) -> list[Any]:
    """Return the step that waits for the result of a goal at a distance (m), a little longer than its time limit."""
    return ["arrive", name, 36.0 + 15.0 * distance]


GO = in_order(["go", "go", -1.4, 1.4, -2.6], arrive("go", 2.0), ["wait", QUIET_TIME])
HERE = in_order(
    *(["go", "stay", 0.0, 0.0, 0.0], ["end", "stay"], ["wait", QUIET_TIME]),
    *(["cut_power"], ["go", "unpowered", 1.0, 0.0, 0.0]),
)
IMPOSSIBLE = in_order(
    *WRONG_POSES,
    *(["ask", f"tolerance {value:g}", "tolerance", value] for value in (0.03, -0.2, math.nan)),
    robot=RESTING,
)
ASTRAY = in_order(
    *(["go", "go", 1.8, 0.0, 0.0], ["get_away", 0.9], ["lead_astray", 4.0, 1]),
    *(arrive("go", 1.8), ["go_on", "undisturbed", 0.4, 0.0, 0.0], arrive("undisturbed", 0.4)),
)
HELD = in_order(
    *(["go", "held", 1.0, 0.0, 0.0], ["get_away", 0.55], ["hold"], arrive("held", 1.0)),
    *(["let_go"], ["wait", STOP_AND_STAY_TIME + 0.5]),
)
MID_STRIDE = in_order(
    *(["go", "canceled", 2.0, 0.0, 0.0], ["walk_for", 1.5], ["cancel", "canceled"]),
    *(["end", "canceled"], ["wait", STOP_AND_STAY_TIME]),
)
PREEMPT = in_order(
    *(["go", "old", *FAR], ["walk_for", 2.0], ["go", "new", 1.2, 0.4, 0.5], ["end", "old"]),
    *(arrive("new", 1.0), ["go_on", "interrupted", *FAR], ["walk_for", 0.3], ["interrupt"]),
)
FALL = in_order(["go", "walk", *FAR], ["walk_for", 0.5], ["knock_over", 0.0, 60.0, 0.0], ["end", "walk"])

REJECT = "06_walk_to_a_pose#reject-task"
GOING, RETURNING, HOLDING = (partial(check_of, on=scenario) for scenario in (GO, ASTRAY, HELD))

server_appears = standard.server_appears(
    "the action navigate_to_pose", on=INTERRUPT, see="06_walk_to_a_pose#small-intro", clauses=[21]
)
accepts_a_goal = GOING(model.accepts, needs=server_appears)
once_it_accepts = partial(check_of, needs=accepts_a_goal)
arrives = GOING(
    [model.succeeds, model.stands_at_success, model.names_no_error],
    title="The goal SUCCEEDS, and the robot then stands within 0.10 m and 0.15 rad of the pose (tolerance 0)",
    points=2,
    needs=accepts_a_goal,
)
once_it_arrives = partial(check_of, needs=arrives)
faces_its_way = GOING(model.faces_its_way, needs=arrives)
feedback_keeps_its_rate = GOING(model.feedback_at_5_hz, needs=accepts_a_goal)
ARRIVES_WITH_FEEDBACK = [arrives, feedback_keeps_its_rate]
feedback_is_true = GOING(
    model.feedback_is_true,
    title="Pose and distance in the feedback are the robot's, for this goal",
    needs=feedback_keeps_its_rate,
)
names_its_phases = GOING(model.names_its_phases, needs=[faces_its_way, *ARRIVES_WITH_FEEDBACK])
tells_its_time = check_of(model.tells_its_time, on=[GO, PREEMPT], needs=ARRIVES_WITH_FEEDBACK)
estimates_the_time = GOING(model.estimates_the_time, needs=ARRIVES_WITH_FEEDBACK)
progress_rises_to_100 = GOING(
    [model.progress_rises, model.half_done_half_way],
    title="progress_percentage rises, is about 50 when half of the distance is left, and ends at 100",
    needs=ARRIVES_WITH_FEEDBACK,
)
measures_its_path = once_it_arrives(
    model.measures_its_path,
    title="distance_traveled is the path walked for this goal, within 15 %, without the sway of the pelvis",
    points=2,
    on=[GO, PREEMPT],
    see="08_navigation#sway-why",
)
counts_no_detour_without_one = GOING(model.counts_no_recovery, needs=feedback_keeps_its_rate)
feedback_ends_with_the_goal = GOING(model.feedback_ends_with_the_goal, needs=ARRIVES_WITH_FEEDBACK)
succeeds_at_once_where_it_stands = once_it_arrives(
    [model.succeeds_where_it_stands, model.progress_rises],
    title="A goal equal to the present pose SUCCEEDS at once, with 100 % and without walking",
    on=HERE,
)
rejects_a_wrong_pose = once_it_accepts(
    [model.rejects_frames, model.rejects_nan],
    title="It rejects a pose in frame map, and one with NaN",
    on=IMPOSSIBLE,
    see="08_navigation#map-why",
)
rejects_a_wrong_tolerance = once_it_accepts(model.rejects_tolerances, on=IMPOSSIBLE, see=REJECT)
rejects_without_power = once_it_accepts(model.rejects_without_power, on=HERE, see=REJECT)
gets_back_on_its_way = RETURNING(model.finds_its_way_back, points=2, needs=arrives)
counts_the_recovery = RETURNING(
    [model.counts_the_detour, model.counts_no_recovery],
    title="number_of_recoveries counts a detour once, and starts at 0 for the next goal",
    needs=[gets_back_on_its_way, feedback_keeps_its_rate],
)
progress_never_falls = RETURNING(
    [model.progress_rises, model.finds_its_way_back],
    title="progress_percentage does not fall when an operator walks the robot back",
    needs=[gets_back_on_its_way, progress_rises_to_100],
    see="08_navigation#zero-fix-why",
)
measures_a_detour = RETURNING(
    model.measures_its_path,
    title="distance_traveled includes a detour",
    needs=[gets_back_on_its_way, measures_its_path],
)
gives_up_in_time = HOLDING(
    [model.gives_up_in_time, model.says_why_it_aborted],
    title="If the robot is held, the goal is ABORTED with TIMEOUT after 30 s plus 15 s per metre",
    points=2,
    needs=arrives,
)
stands_still_after_the_limit = HOLDING(model.stands_after_the_limit, needs=gives_up_in_time)
measures_what_was_walked = HOLDING(
    model.measures_its_path,
    title="distance_traveled is the path that was walked, not the one that was commanded",
    needs=[gives_up_in_time, measures_its_path],
)
cancels_in_mid_stride = once_it_accepts(
    [model.grants_cancels, model.walks_until_canceled, model.stops_when_canceled, model.names_no_error],
    title="After a cancel while the robot walks, the goal ends CANCELED, and the robot is still and upright within 2 s",
    points=2,
    on=MID_STRIDE,
)
new_goal_preempts_the_old = once_it_arrives(
    [model.accepts, model.gives_way, model.says_why_it_aborted, model.succeeds],
    title="A new goal aborts the old one with PREEMPTED, and the robot walks to the new one",
    points=2,
    on=PREEMPT,
    see="07_cancel_and_preempt#preempt-why",
)
aborts_when_the_robot_falls = once_it_accepts(
    [model.tells_a_fall, model.says_why_it_aborted],
    title="When the robot falls, the goal is ABORTED with FELL",
    on=FALL,
)
ends_cleanly = standard.ends_cleanly(
    on=[INTERRUPT, PREEMPT], needs=server_appears, see="07_cancel_and_preempt#conventions", clauses=[21]
)
