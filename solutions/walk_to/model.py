"""What must hold of every goal of walk_to, and of the robot while none is active, clause by clause."""

from __future__ import annotations

from autograder.authoring.goal import Goal
from autograder.authoring.obligation import Obligation, goals, obligation, whole_run
from autograder.authoring.walking.objections import (
    BUSY,
    FRAME,
    NO_ODOM,
    NO_POWER,
    NO_ROTATION,
    NOT_FINITE,
    VELOCITY,
    Objection,
    accepting,
    one_of_several,
    rejecting,
)
from autograder.authoring.walking.obligations import cancels, ends, tells, walks


def _rejects(clause: int, name: str, objection: Objection, sentence: str) -> Obligation:
    return obligation(clause, of=goals)(rejecting(name, objection, sentence))


_accept = accepting(FRAME, NOT_FINITE, NO_ROTATION, VELOCITY, NO_ODOM, NO_POWER, BUSY)


def _accept_unless_busy(goal: Goal) -> str | None:
    """It accepts a pose in frame odom when nothing speaks against it but perhaps a goal that it should have rejected"""
    return "while another is active" if BUSY.holds(goal) is not False else _accept(goal)


accepts = obligation(1, 4, 5, of=goals)(_accept)
accepts_unless_busy = obligation(4, of=goals)(_accept_unless_busy)
rejects_frames = _rejects(1, "rejects_frames", FRAME, "It rejects a pose in any other frame than odom")
rejects_nan = _rejects(2, "rejects_nan", NOT_FINITE, "It rejects a pose that holds NaN or infinity")
rejects_no_rotation = _rejects(
    2, "rejects_no_rotation", NO_ROTATION, "It rejects an orientation of four zeros"
)
rejects_velocities = _rejects(
    3, "rejects_velocities", VELOCITY, "It rejects a max_velocity that is negative, NaN or infinite"
)
rejects_before_odom = _rejects(
    4, "rejects_before_odom", NO_ODOM, "It rejects goals before the first odom, and accepts them after it"
)
rejects_without_power = _rejects(
    4, "rejects_without_power", NO_POWER, "It rejects a goal while the motors are off"
)
rejects_while_busy = _rejects(5, "rejects_while_busy", BUSY, "It rejects a goal while another runs")
takes_one_of_several = obligation(5, of=goals)(one_of_several)
refuses_cancels = obligation(5, of=goals)(cancels.refuses_cancels)
goes_on = obligation(5, of=goals)(ends.goes_on)
comes_near = obligation(6, of=goals)(ends.comes_near)
turns_the_short_way = obligation(6, of=goals)(walks.turns_the_short_way)
obeys_max_velocity = obligation(7, of=goals)(walks.obeys_max_velocity)
walks_at_its_own_velocity = obligation(7, of=goals)(walks.walks_at_its_own_velocity)
ends_with_a_zero_twist = obligation(8, of=goals)(walks.ends_with_a_zero_twist)
does_not_steer_without_a_goal = obligation(8, of=whole_run)(walks.does_not_steer_without_a_goal)
succeeds = obligation(9, of=goals)(ends.succeeds)
status_in_order = obligation(9, of=goals)(ends.status_in_order)
stands_at_success = obligation(9, of=goals)(walks.stands_at_success)
stands_without_a_goal = obligation(9, of=whole_run)(walks.stands_without_a_goal)
reports_where_it_ended = obligation(10, of=goals)(tells.reports_where_it_ended)
feedback_at_5_hz = obligation(11, of=goals)(tells.feedback_at_5_hz)
feedback_is_true = obligation(11, of=goals)(tells.feedback_is_true)
estimates_the_time = obligation(11, of=goals)(tells.estimates_the_time)
feedback_ends_with_the_goal = obligation(11, of=goals)(tells.feedback_ends_with_the_goal)
tells_a_fall = obligation(12, of=goals)(ends.tells_a_fall)
says_why_it_aborted = obligation(12, of=goals)(tells.says_why_it_aborted)
