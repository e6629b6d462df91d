"""What must hold for every goal of pick_and_place, clause by clause."""

from __future__ import annotations

from autograder.authoring import CANCELED, SUCCEEDED, Goal, Obligation, goals, obligation
from autograder.authoring.walking.life import accepted, others, phase
from autograder.authoring.walking.objections import rejects
from autograder.authoring.walking.obligations import reporting
from autograder.authoring.walking.obligations.cancels import answers_every_cancel
from autograder.authoring.walking.obligations.ends import status_in_order

from . import holding, objections, placing, reports, safe_ends
from .life import rivals


@obligation(1, of=goals, see="07_cancel_and_preempt#m2-why")
def accepts(goal: Goal) -> str | None:
    """It accepts a place in frame odom with a possible grasp_force when no goal is active, also after others."""
    if not objections.is_sound(goal) or rivals(goal):
        return None
    if any(accepted(other) and other.sent.t < goal.sent.t for other in others(goal)):
        goal.require_accepted(
            help=f"This goal is valid: a finite place in odom, {goal.request.grasp_force:g} N of at most "
            f"{objections.MAX_FORCE:g} N, and no other goal is active. Record in a `finally` block of execute "
            "that the hand is free, so that it is free however execute ends."
        )
    goal.require_accepted()
    return phase(goal)


rejects_frames = rejects(1, objections.frames)
rejects_not_finite = rejects(1, objections.not_finite)
rejects_forces = rejects(1, objections.forces)
places = obligation(2, 3, of=goals, see="09_arms#careful-why")(placing.places)
lifts = obligation(4, of=goals, see="09_arms#firm-why")(holding.lifts)
puts_down = obligation(4, of=goals)(placing.puts_down)
keeps_force = obligation(5, of=goals, see="09_arms#force-why")(holding.keeps_the_force_asked_for)
names_stages = obligation(6, of=goals, see="09_arms#lift-intro")(reports.names_stages_in_order)
true_stages = obligation(6, of=goals, see="09_arms#conventions")(reports.stages_are_true_at)
feedback_at_5_hz = obligation(7, of=goals, see="07_cancel_and_preempt#conventions")(reports.feedback_at_5_hz)
no_late_feedback = obligation(7, of=goals, see="07_cancel_and_preempt#m13-why")(
    reporting.feedback_ends_with_the_goal
)
measured = obligation(8, of=goals, see="09_arms#force-why")(reports.values_are_measured)
percentage = obligation(9, of=goals, see="08_navigation#zero-fix-why")(reports.percentage_never_falls)
filled_result = obligation(10, of=goals, see="06_walk_to_a_pose#late-why")(placing.fills_the_result_in)
unknown_objects = obligation(11, of=goals, see="09_arms#conventions")(safe_ends.knows_what_is_unknown)
out_of_reach = obligation(12, of=goals, see="09_arms#conventions")(safe_ends.refuses_what_is_out_of_reach)
empty_hand = obligation(13, of=goals, see="09_arms#force-why")(safe_ends.notices_what_it_does_not_hold)
withdraws_empty = obligation(13, of=goals, see="09_arms#force-why")(safe_ends.withdraws_what_is_empty)
gives_up_in_time = obligation(14, of=goals, see="09_arms#hand-intro")(safe_ends.gives_up_in_time)
lost_object = obligation(15, of=goals, see="09_arms#slip-why")(safe_ends.notices_what_it_loses)
tells_a_fall = obligation(16, of=goals, see="07_cancel_and_preempt#fall-why")(safe_ends.tells_a_fall)
says_why_it_aborted = obligation(17, of=goals)(reporting.says_why_it_aborted)
leaves_the_cup = obligation(18, of=goals, see="07_cancel_and_preempt#m1-why")(safe_ends.leaves_the_cup)
puts_away = obligation(19, of=goals, see="09_arms#lift-why")(safe_ends.puts_away)
answers_cancels = obligation(18, 19, of=goals)(answers_every_cancel)
keeps_order = obligation(18, 19, of=goals)(status_in_order)
one_hand = obligation(20, of=goals, see="07_cancel_and_preempt#preempt-why")(safe_ends.gives_the_hand_to_one)


# -- a goal after an earlier one --------------------------------------------------------------------------------------


def _places_after(status: int, sentence: str) -> Obligation:
    def require(goal: Goal) -> str | None:
        earlier = [other for other in others(goal) if other.sent.t < goal.sent.t]
        return placing.places(goal) if any(other.status == status for other in earlier) else None

    require.__doc__ = sentence
    return obligation(3, of=goals)(require)


places_again = _places_after(SUCCEEDED, "After one goal it carries out another")
places_after_a_cancel = _places_after(CANCELED, "After a cancel it carries out another goal")
