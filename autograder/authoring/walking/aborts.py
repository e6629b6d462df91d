"""What must abort a walk: a fall, and where the newest goal has the robot, a newer goal."""

from __future__ import annotations

from autograder.authoring.failure import expect
from autograder.authoring.falls import require_fell_told
from autograder.authoring.goal import ABORTED, Goal
from autograder.authoring.walking.reports import require_error_code
from autograder.authoring.walking.truth import (
    require_accepted,
    require_arrival,
    require_fall,
    require_walking,
)


def require_aborted_by_a_fall(goal: Goal) -> None:
    """Require that the goal went on until the robot fell, and was then ABORTED with FELL."""
    require_fell_told(goal, require_fall(require_accepted(goal).run))


def require_preempted(old: Goal, new: Goal) -> None:
    """Require that a goal sent while the robot walked ABORTED the older one with PREEMPTED, and was reached."""
    require_accepted(old)
    require_accepted(
        new,
        help="The new goal was rejected because another was active: accept it, and let the older one give way.",
    )
    require_walking(new.run, new.sent.t)
    end = old.require_result(
        ABORTED,
        help="The old goal went on after the new one was accepted. How does its loop learn that it is no longer the "
        "newest? (handle_accepted_callback)",
    )
    require_error_code(old, "PREEMPTED", because="a new goal has taken its place")
    old.require_reason()
    expect(
        end.t >= new.sent.t,
        expected="the old goal to go on until the new one comes",
        observed=f"it ended {new.sent.t - end.t:.1f} s before",
        help="Abort with PREEMPTED only when another goal has been accepted.",
        at=end.t,
    )
    require_arrival(new)
