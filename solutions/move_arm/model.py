"""What must hold of every goal of move_arm, and of the arms while none is active, clause by clause."""

from __future__ import annotations

from collections.abc import Callable

from autograder.authoring import events as ev
from autograder.authoring.goal import CANCELED, Goal
from autograder.authoring.obligation import Obligation, goals, obligation, whole_run
from autograder.authoring.walking.life import phase
from autograder.authoring.walking.objections import rejecting
from autograder.authoring.walking.obligations.cancels import answers_every_cancel
from autograder.authoring.walking.obligations.ends import status_in_order
from autograder.authoring.walking.obligations.tells import (
    feedback_ends_with_the_goal as no_feedback_afterwards,
)

from . import ends, motion, reports
from .life import hold_of, is_carried_out, neighbours, rivals
from .objections import (
    AGAINST,
    ARM,
    JOINT,
    LENGTH,
    NO_POINT,
    NOT_FINITE,
    RANGE,
    TIMES,
    UNSAID,
    Objection,
)
from .truth import require_accepted


def _rejects(clause: int, name: str, objection: Objection, sentence: str) -> Obligation:
    return obligation(clause, of=goals)(rejecting(name, objection, sentence))


@obligation(1, 15, of=goals)
def accepts(goal: Goal) -> str | None:
    """It accepts a trajectory of one arm's joints when nothing speaks against it, whatever the arms do."""
    if any(objection.holds(goal) is not False for objection in (*AGAINST, UNSAID)):
        return None
    require_accepted(goal)
    return f"arm {goal.request.arm}, {phase(goal)}"


rejects_arms = _rejects(2, "rejects_arms", ARM, "It rejects an arm that is neither l nor r")
rejects_joints = _rejects(2, "rejects_joints", JOINT, "It rejects joints that are not this arm's")
rejects_no_point = _rejects(3, "rejects_no_point", NO_POINT, "It rejects a trajectory without a point")
rejects_lengths = _rejects(
    3, "rejects_lengths", LENGTH, "It rejects points with too few or too many positions"
)
rejects_times = _rejects(
    4, "rejects_times", TIMES, "It rejects a trajectory whose times do not rise from point to point"
)
rejects_not_finite = _rejects(
    5, "rejects_not_finite", NOT_FINITE, "It rejects a trajectory that holds NaN or an infinite position"
)
rejects_beyond = _rejects(5, "rejects_beyond", RANGE, "It rejects a position outside the joint's range")
passes_points = obligation(6, of=goals)(motion.passes_every_point)
succeeds = obligation(7, of=goals)(ends.succeeds)
names_no_error = obligation(8, of=goals)(reports.names_no_error)
misses = obligation(9, of=goals)(ends.misses)
strays = obligation(10, of=goals)(ends.strays)
holds_when_given_up = obligation(10, 12, of=goals)(motion.holds_when_given_up)
names_the_joint = obligation(11, of=goals)(reports.names_the_joint)
notices_silence = obligation(12, of=goals)(ends.notices_silence)
feedback_at_10_hz = obligation(13, of=goals)(reports.feedback_at_10_hz)
feedback_is_true = obligation(13, of=goals)(reports.feedback_is_true)
no_late_feedback = obligation(13, of=goals)(no_feedback_afterwards)
grants_cancels = obligation(14, of=goals)(ends.grants_cancels)
answers_cancels = obligation(14, of=goals)(answers_every_cancel)
moves_until_canceled = obligation(14, of=goals)(motion.moves_until_canceled)
stops_when_canceled = obligation(14, of=goals)(motion.stops_when_canceled)
stops_by_an_empty_trajectory = obligation(14, of=goals)(motion.stops_by_an_empty_trajectory)
keeps_order = obligation(14, of=goals)(status_in_order)
gives_way = obligation(15, of=goals)(ends.gives_way)
stays_without_a_goal = obligation(16, of=whole_run)(motion.stays_without_a_goal)


# -- what becomes of a goal in particular situations ------------------------------------------------------------------


def _succeeds_if(*clauses: int, sentence: str, when: Callable[[Goal], bool]) -> Obligation:
    def require(goal: Goal) -> str | None:
        return ends.succeeds(goal) if is_carried_out(goal) and when(goal) else None

    require.__doc__ = sentence
    return obligation(*clauses, of=goals)(require)


def _joints_were_listed_otherwise(goal: Goal) -> bool:
    return any(
        each.command.get("reversed") and each.t < goal.sent.t for each in goal.run.all(ev.RobotCommanded)
    )


def _came_after_a_cancel(goal: Goal) -> bool:
    earlier = [other for other in rivals(goal) if other.sent.t < goal.sent.t]
    return bool(earlier) and earlier[-1].status == CANCELED


succeeds_by_name = _succeeds_if(
    7,
    sentence="It measures by the joints' names, in whatever order joint_states lists them",
    when=_joints_were_listed_otherwise,
)
succeeds_by_its_tolerance = _succeeds_if(
    7,
    sentence="A joint within goal_tolerance of its end is near enough",
    when=lambda goal: bool(goal.request.goal_tolerance) and hold_of(goal) is not None,
)
succeeds_late = _succeeds_if(
    7,
    sentence="A joint that gets to its end within 1 s of its time is in time",
    when=lambda goal: not goal.request.goal_tolerance and hold_of(goal) is not None,
)
succeeds_after_a_cancel = _succeeds_if(
    7, sentence="A new goal after a cancel is carried out", when=_came_after_a_cancel
)
succeeds_beside_the_other = _succeeds_if(
    16,
    sentence="What happens to one arm's goal leaves the other arm alone",
    when=lambda goal: bool(neighbours(goal)),
)
