"""The checks that students can see and run themselves."""

from __future__ import annotations

from functools import partial

from autograder.authoring import RESTING, check_of, standard
from autograder.authoring.walking import server_checks
from autograder.authoring.walking.server_checks import INTERRUPT, WRONG_POSES, in_order

from . import model

FAR = [2.0, 0.0, 0.0]  # m, m, rad
STAY_TIME = 2.6  # s after the result of a cancelled goal, in which the robot must stand
STOPPING_TIME = 0.35  # s from a cancel to a goal that comes while the robot is still stopping

WALK = server_checks.two_walks()
IMPOSSIBLE = in_order(*WRONG_POSES, robot=RESTING)
UNPOWERED = in_order(["cut_power"], ["go", "unpowered", 1.0, 0.0, 0.0])
CANCEL = in_order(
    *(["go", "canceled", *FAR], ["walk_for", 1.0], ["cancel", "canceled"]),
    *(["end", "canceled"], ["wait", STAY_TIME]),
    *(["go_on", "early", *FAR], ["cancel", "early"], ["end", "early"], ["wait", 1.0]),
    *(["go_on", "hasty", *FAR], ["walk_for", 0.5], ["cancel", "hasty"], ["wait", STOPPING_TIME]),
    *(["go_on", "again", 0.5, 0.0, 0.0], ["end", "hasty"], ["arrive", "again"], ["wait", 1.0]),
)
PREEMPT = in_order(
    *(["go", "old", *FAR], ["walk_for", 1.7], ["ask", "in map", "header.frame_id", "map"], ["wait", 0.3]),
    *(["go", "new", 0.9, 0.2, 0.3], ["end", "old"], ["arrive", "new"], ["wait", 1.0]),
    *(["go", "interrupted", *FAR], ["walk_for", 0.3], ["interrupt"]),
)
FALL = in_order(["go", "walk", *FAR], ["walk_for", 0.5], ["knock_over", 0.0, 60.0, 0.0], ["end", "walk"])

server_appears = standard.server_appears(
    "the action walk_to", on=INTERRUPT, clauses=[13], see="07_cancel_and_preempt#fix-file"
)
accepts_a_goal = check_of(
    model.accepts, title="It accepts a pose in frame odom", on=FALL, needs=server_appears
)
arrives = check_of(
    [model.succeeds, model.stands_at_success, model.turns_the_short_way, model.walks_at_its_own_velocity],
    title="The goal SUCCEEDS with the robot within 0.10 m and 0.15 rad of the pose, after turning the shorter way",
    points=2,
    on=WALK,
    needs=accepts_a_goal,
)
fills_the_result, feedback_keeps_its_rate, feedback_is_true, feedback_ends_with_the_goal = (
    server_checks.reports(
        model,
        on=WALK,
        under_way=accepts_a_goal,
        arrives=arrives,
    )
)
rejects_a_wrong_frame, rejects_nan = server_checks.rejections(
    model, on=IMPOSSIBLE, needs=accepts_a_goal, see="07_cancel_and_preempt#conventions"
)
rejects_without_power = check_of(
    model.rejects_without_power, on=UNPOWERED, needs=accepts_a_goal, see="07_cancel_and_preempt#conventions"
)
of_a_cancel = partial(check_of, on=CANCEL)
cancels_in_mid_stride = of_a_cancel(
    model.canceled_in_mid_stride,
    title="A cancel while the robot walks is accepted, and the goal ends CANCELED",
    points=2,
    needs=accepts_a_goal,
    see="07_cancel_and_preempt#m1-why",
)
stops_when_canceled = of_a_cancel(model.stops_when_canceled, points=2, needs=cancels_in_mid_stride)
walks_again_after_a_cancel = of_a_cancel(
    [model.accepts, model.grants_cancels, model.succeeds, model.reports_where_it_ended],
    title="After a cancel, also an early one, the robot walks to a new goal, and the results are measured",
    needs=[cancels_in_mid_stride, arrives, fills_the_result],
    see="07_cancel_and_preempt#fix-intro",
)
new_goal_preempts_the_old = check_of(
    [model.accepts, model.gives_way, model.says_why_it_aborted, model.succeeds, model.reports_where_it_ended],
    title="An accepted new goal, but not a rejected one, aborts the old with PREEMPTED; the robot walks to it, and the "
    "results are measured",
    points=2,
    on=PREEMPT,
    needs=[arrives, fills_the_result],
    see="07_cancel_and_preempt#preempt-why",
)
aborts_when_the_robot_falls = server_checks.fall_is_reported(model, on=FALL, needs=accepts_a_goal)
ends_cleanly = standard.ends_cleanly(
    clauses=[13], on=[INTERRUPT, PREEMPT], needs=server_appears, see="07_cancel_and_preempt#conventions"
)
