"""What must hold for every goal of the cancellable walk, and for the robot without a goal."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from autograder.authoring import Goal, Obligation, Transcript, goals, obligation, whole_run
from autograder.authoring.walking import objections
from autograder.authoring.walking.objections import accepting, rejects
from autograder.authoring.walking.obligations import cancels, ends, reporting, walks

accepts = obligation(1, 3, 11, of=goals, see="07_cancel_and_preempt#m2-why")(
    accepting(
        objections.frames,
        objections.nan,
        objections.without_power,
        objections.UNSAID_ROTATION,
        objections.UNSAID_VELOCITY,
    )
)
rejects_frames = rejects(1, objections.frames)
rejects_nan = rejects(2, objections.nan)
rejects_without_power = rejects(3, objections.without_power)
walks_at_its_own_velocity = obligation(4, of=goals)(walks.walks_at_its_own_velocity)
succeeds = obligation(5, 6, of=goals, see="07_cancel_and_preempt#fix-intro")(ends.succeeds)
status_in_order = obligation(5, of=goals)(ends.status_in_order)
stands_at_success = obligation(5, of=goals)(walks.stands_at_success)
stands_without_a_goal = obligation(5, 9, of=whole_run)(walks.stands_without_a_goal)
turns_the_short_way = obligation(6, of=goals)(walks.turns_the_short_way)
goes_on = obligation(1, of=goals)(ends.goes_on)
feedback_at_5_hz = obligation(7, of=goals, see="07_cancel_and_preempt#conventions")(
    reporting.feedback_at_5_hz
)
feedback_is_true = obligation(7, of=goals, see="07_cancel_and_preempt#turner-intro")(
    reporting.feedback_is_true
)
estimates_the_time = obligation(7, of=goals)(reporting.estimates_the_time)
feedback_ends_with_the_goal = obligation(7, of=goals, see="07_cancel_and_preempt#m13-why")(
    reporting.feedback_ends_with_the_goal
)
reports_where_it_ended = obligation(8, of=goals, see="07_cancel_and_preempt#m13-why")(
    reporting.reports_where_it_ended
)
says_why_it_aborted = obligation(8, of=goals)(reporting.says_why_it_aborted)
grants_cancels = obligation(9, of=goals, see="07_cancel_and_preempt#why")(cancels.grants_cancels)
stops_when_canceled = obligation(9, of=goals, see="07_cancel_and_preempt#m12-robot-why")(
    cancels.stops_when_canceled
)
answers_every_cancel = obligation(9, of=goals)(cancels.answers_every_cancel)
refuses_late_cancels = obligation(10, of=goals, see="07_cancel_and_preempt#late-why")(
    cancels.refuses_late_cancels
)
gives_way = obligation(11, of=goals)(ends.gives_way)
only_one_is_newest = obligation(11, of=goals)(ends.only_one_is_newest)
tells_a_fall = obligation(12, of=goals, see="07_cancel_and_preempt#fall-why")(ends.tells_a_fall)


def _of(
    *names: str,
    require: Sequence[Callable[[Goal], str | None]] = (cancels.grants_cancels, cancels.stops_when_canceled),
) -> tuple[Obligation, ...]:
    """Return obligations of the goals with these names: by default, the cancel is accepted and the robot stops."""

    def some(run: Transcript) -> list[Goal]:
        return [run.goal(name) for name in names]

    return tuple(obligation(9, of=some)(each) for each in require)


canceled_in_mid_stride = _of("canceled", require=(cancels.grants_cancels, cancels.walks_until_canceled))
canceled_at_the_start = _of("at once", "first feedback")
canceled_near_arrival = _of("near")
canceled_twice = _of("twice")
canceled_by_a_stranger = _of("stranger")
