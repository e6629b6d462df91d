"""What must hold of every goal of navigate_to_pose, and of the robot while none is active, clause by clause."""

from __future__ import annotations

from autograder.authoring import Goal, goals, obligation, whole_run
from autograder.authoring.walking import objections
from autograder.authoring.walking.objections import accepting, objection, rejects
from autograder.authoring.walking.obligations import cancels, ends, tells, walks

from . import odometer, phases, progress, recoveries, times

SMALLEST = 0.05  # m


@objection(
    "0 asks for the default of 0.10 m; anything else below 0.05 m is rejected, negative numbers and NaN too: "
    "NaN < 0.05 is false, so ask math.isfinite() as well."
)
def _tolerances(goal: Goal) -> str | None:
    """It rejects a tolerance that is NaN, or below 0.05 m and not 0."""
    tolerance = goal.request.tolerance
    if abs(tolerance - SMALLEST) < 1e-6:
        return None  # as a float it may be a little less
    can_be_kept = tolerance == 0.0 or tolerance >= SMALLEST
    return "" if can_be_kept else f"a tolerance of {tolerance:g} m cannot be kept"


accepts = obligation(1, 2, 18, of=goals, see="06_walk_to_a_pose#reject-task")(
    accepting(
        objections.frames, objections.nan, objections.UNSAID_ROTATION, _tolerances, objections.without_power
    )
)
rejects_frames = rejects(1, objections.frames)
rejects_nan = rejects(1, objections.nan)
rejects_without_power = rejects(1, objections.without_power)
rejects_tolerances = rejects(2, _tolerances)
goes_on = obligation(1, of=goals)(ends.goes_on)
faces_its_way = obligation(3, of=goals, see="08_navigation#why")(phases.faces_its_way)
succeeds = obligation(2, 4, of=goals, see="06_walk_to_a_pose#settle-why")(ends.succeeds)
stands_at_success = obligation(4, of=goals)(walks.stands_at_success)
status_in_order = obligation(4, of=goals)(ends.status_in_order)
succeeds_where_it_stands = obligation(5, of=goals, see="08_navigation#zero-why")(
    times.succeeds_where_it_stands
)
feedback_at_5_hz = obligation(6, of=goals, see="06_walk_to_a_pose#settle-intro")(tells.feedback_at_5_hz)
feedback_ends_with_the_goal = obligation(6, of=goals, see="07_cancel_and_preempt#m13-why")(
    tells.feedback_ends_with_the_goal
)
feedback_is_true = obligation(7, of=goals, see="08_navigation#action-intro")(tells.feedback_is_true)
names_its_phases = obligation(8, of=goals, see="08_navigation#loops-intro")(phases.names_its_phases)
tells_its_time = obligation(9, of=goals, see="08_navigation#conventions")(times.tells_its_time)
estimates_the_time = obligation(10, of=goals, see="08_navigation#eta-why")(times.estimates_the_time)
progress_rises = obligation(5, 11, of=goals, see="08_navigation#zero-why")(progress.progress_rises)
half_done_half_way = obligation(11, of=goals)(progress.half_done_half_way)
measures_its_path = obligation(12, 13, of=goals, see="08_navigation#odometer-why")(odometer.measures_its_path)
finds_its_way_back = obligation(14, 15, of=goals, see="08_navigation#loops-why")(
    recoveries.finds_its_way_back
)
counts_no_recovery = obligation(15, of=goals, see="08_navigation#recovery-why")(recoveries.counts_no_recovery)
counts_the_detour = obligation(14, 15, of=goals, see="08_navigation#recovery-why")(
    recoveries.counts_the_detour
)
gives_up_in_time = obligation(16, of=goals, see="08_navigation#late-why")(times.gives_up_in_time)
stands_after_the_limit = obligation(16, of=goals, see="06_walk_to_a_pose#touch-why")(
    times.stands_after_the_limit
)
grants_cancels = obligation(17, of=goals, see="07_cancel_and_preempt#fix-intro")(cancels.grants_cancels)
walks_until_canceled = obligation(17, of=goals)(cancels.walks_until_canceled)
stops_when_canceled = obligation(17, of=goals)(cancels.stops_when_canceled)
stands_without_a_goal = obligation(4, 16, 17, of=whole_run)(walks.stands_without_a_goal)
gives_way = obligation(18, of=goals)(ends.gives_way)
tells_a_fall = obligation(19, of=goals, see="07_cancel_and_preempt#fall-why")(ends.tells_a_fall)
names_no_error = obligation(20, of=goals)(tells.names_no_error)
says_why_it_aborted = obligation(20, of=goals)(tells.says_why_it_aborted)
