"""What must hold for every goal of move_arm, and for the arms without a goal, clause by clause."""

from __future__ import annotations

from collections.abc import Callable

from autograder.authoring import CANCELED, Goal, Obligation, ev, goals, obligation, whole_run
from autograder.authoring.walking.life import phase, rivals
from autograder.authoring.walking.objections import rejects
from autograder.authoring.walking.obligations import cancels, reporting
from autograder.authoring.walking.obligations.ends import status_in_order

from . import ends, motion, objections, reports
from .life import hold_of, is_carried_out, neighbours
from .truth import require_accepted


@obligation(1, 15, of=goals, see="09_arms#conventions")
def accepts(goal: Goal) -> str | None:
    """It accepts a valid trajectory for one arm's joints, whatever the arms do at that time."""
    if not objections.is_sound(goal):
        return None
    require_accepted(goal)
    return f"arm {goal.request.arm}, {phase(goal)}"


rejects_arms = rejects(2, objections.arms)
rejects_joints = rejects(2, objections.joints)
rejects_no_point = rejects(3, objections.no_point)
rejects_lengths = rejects(3, objections.lengths)
rejects_times = rejects(4, objections.times)
rejects_not_finite = rejects(5, objections.not_finite)
rejects_beyond = rejects(5, objections.beyond)
passes_points = obligation(6, of=goals, see="09_arms#velocities-why")(motion.passes_every_point)
succeeds = obligation(7, of=goals, see="09_arms#clock-why")(ends.succeeds)
names_no_error = obligation(8, of=goals, see="07_cancel_and_preempt#m13-why")(reports.names_no_error)
misses = obligation(9, of=goals, see="09_arms#bend-why")(ends.misses)
strays = obligation(10, of=goals, see="09_arms#bend-why")(ends.strays)
holds_when_given_up = obligation(10, 12, of=goals, see="09_arms#release-why")(motion.holds_when_given_up)
names_the_joint = obligation(11, of=goals, see="09_arms#bend-why")(reports.names_the_joint)
notices_silence = obligation(12, of=goals, see="09_arms#conventions")(ends.notices_silence)
feedback_at_10_hz = obligation(13, of=goals, see="07_cancel_and_preempt#conventions")(
    reports.feedback_at_10_hz
)
feedback_is_true = obligation(13, of=goals, see="09_arms#bend-why")(reports.feedback_is_true)
no_late_feedback = obligation(13, of=goals, see="07_cancel_and_preempt#m13-why")(
    reporting.feedback_ends_with_the_goal
)
grants_cancels = obligation(14, of=goals, see="07_cancel_and_preempt#m1-why")(ends.grants_cancels)
answers_cancels = obligation(14, of=goals)(cancels.answers_every_cancel)
moves_until_canceled = obligation(14, of=goals)(motion.moves_until_canceled)
stops_when_canceled = obligation(14, of=goals, see="09_arms#brake-why")(motion.stops_when_canceled)
stops_by_an_empty_trajectory = obligation(14, of=goals, see="09_arms#brake-why")(
    motion.stops_by_an_empty_trajectory
)
keeps_order = obligation(14, of=goals)(status_in_order)
gives_way = obligation(15, of=goals)(ends.gives_way)
stays_without_a_goal = obligation(16, of=whole_run)(motion.stays_without_a_goal)


# -- how goals end in particular situations ---------------------------------------------------------------------------


def _succeeds_if(*clauses: int, sentence: str, when: Callable[[Goal], bool]) -> Obligation:
    def require(goal: Goal) -> str | None:
        return ends.succeeds(goal) if is_carried_out(goal) and when(goal) else None

    require.__doc__ = sentence
    return obligation(*clauses, of=goals)(require)


def _joints_were_reordered(goal: Goal) -> bool:
    return any(
        each.command.get("reversed") and each.t < goal.sent.t for each in goal.run.all(ev.RobotCommanded)
    )


def _came_after_a_cancel(goal: Goal) -> bool:
    earlier = [other for other in rivals(goal) if other.sent.t < goal.sent.t]
    return bool(earlier) and earlier[-1].status == CANCELED


succeeds_by_name = _succeeds_if(
    7,
    sentence="It looks up joints by name, whatever their order in joint_states",
    when=_joints_were_reordered,
)
succeeds_by_its_tolerance = _succeeds_if(
    7,
    sentence="The goal SUCCEEDS when a blocked joint is within goal_tolerance of its last position",
    when=lambda goal: bool(goal.request.goal_tolerance) and hold_of(goal) is not None,
)
succeeds_late = _succeeds_if(
    7,
    sentence="The goal SUCCEEDS when a joint arrives late, but within 1 s after the last point is due",
    when=lambda goal: not goal.request.goal_tolerance and hold_of(goal) is not None,
)
succeeds_after_a_cancel = _succeeds_if(
    7, sentence="After a cancel, a new goal is carried out", when=_came_after_a_cancel
)
succeeds_beside_the_other = _succeeds_if(
    16,
    sentence="The goal of one arm does not affect the other arm",
    when=lambda goal: bool(neighbours(goal)),
)
