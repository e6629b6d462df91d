"""What must hold for every goal of walk_to, and for the robot without a goal, clause by clause."""

from __future__ import annotations

from autograder.authoring import Goal, goals, obligation, whole_run
from autograder.authoring.walking import objections
from autograder.authoring.walking.objections import accepting, one_of_several, rejects
from autograder.authoring.walking.obligations import cancels, ends, reporting, walks

_accept = accepting(
    objections.frames,
    objections.nan,
    objections.no_rotation,
    objections.velocities,
    objections.before_odom,
    objections.without_power,
    objections.while_busy,
)


def _accept_unless_busy(goal: Goal) -> str | None:
    """It accepts a valid goal, unless an earlier goal that it should have rejected is active"""
    return "while another is active" if objections.while_busy.because(goal) != "" else _accept(goal)


accepts = obligation(1, 4, 5, of=goals, see="01_robot_and_graph#frames-intro")(_accept)
accepts_unless_busy = obligation(4, of=goals)(_accept_unless_busy)
rejects_frames = rejects(1, objections.frames)
rejects_nan = rejects(2, objections.nan)
rejects_no_rotation = rejects(2, objections.no_rotation)
rejects_velocities = rejects(3, objections.velocities)
rejects_before_odom = rejects(4, objections.before_odom)
rejects_without_power = rejects(4, objections.without_power)
rejects_while_busy = rejects(5, objections.while_busy)
takes_one_of_several = obligation(5, of=goals)(one_of_several)
refuses_cancels = obligation(5, of=goals, see="06_walk_to_a_pose#small-intro")(cancels.refuses_cancels)
goes_on = obligation(5, of=goals)(ends.goes_on)
comes_near = obligation(6, of=goals, see="01_robot_and_graph#frames-intro")(ends.comes_near)
turns_the_short_way = obligation(6, of=goals)(walks.turns_the_short_way)
obeys_max_velocity = obligation(7, of=goals, see="06_walk_to_a_pose#show-intro")(walks.obeys_max_velocity)
walks_at_its_own_velocity = obligation(7, of=goals, see="01_robot_and_graph#walk-intro")(
    walks.walks_at_its_own_velocity
)
ends_with_a_zero_twist = obligation(8, of=goals, see="06_walk_to_a_pose#touch-why")(
    walks.ends_with_a_zero_twist
)
does_not_steer_without_a_goal = obligation(8, of=whole_run)(walks.does_not_steer_without_a_goal)
succeeds = obligation(9, of=goals, see="06_walk_to_a_pose#settle-why")(ends.succeeds)
status_in_order = obligation(9, of=goals)(ends.status_in_order)
stands_at_success = obligation(9, of=goals, see="06_walk_to_a_pose#touch-why")(walks.stands_at_success)
stands_without_a_goal = obligation(9, of=whole_run)(walks.stands_without_a_goal)
reports_where_it_ended = obligation(10, of=goals, see="06_walk_to_a_pose#settle-why")(
    reporting.reports_where_it_ended
)
feedback_at_5_hz = obligation(11, of=goals, see="06_walk_to_a_pose#conventions")(reporting.feedback_at_5_hz)
feedback_is_true = obligation(11, of=goals, see="06_walk_to_a_pose#settle-intro")(reporting.feedback_is_true)
estimates_the_time = obligation(11, of=goals)(reporting.estimates_the_time)
feedback_ends_with_the_goal = obligation(11, of=goals, see="06_walk_to_a_pose#settle-intro")(
    reporting.feedback_ends_with_the_goal
)
tells_a_fall = obligation(12, of=goals, see="06_walk_to_a_pose#fall-why")(ends.tells_a_fall)
says_why_it_aborted = obligation(12, of=goals)(reporting.says_why_it_aborted)
