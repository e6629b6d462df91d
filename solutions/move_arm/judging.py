"""Judges goals for arms that were held, replaced, or shared the robot with another."""

from __future__ import annotations

from trajectory_msgs.msg import JointTrajectory

from autograder.authoring.arms.endings import GOAL_TOLERANCE, PATIENCE
from autograder.authoring.arms.motion import (
    require_arrival,
    require_moving,
)
from autograder.authoring.arms.plan import Plan, errors, largest
from autograder.authoring.arms.reports import require_aborted
from autograder.authoring.arms.truth import joints_at, joints_between, plan_of, require_accepted
from autograder.authoring.failure import expect
from autograder.authoring.goal import ABORTED, Goal
from autograder.authoring.missing import unseen
from autograder.authoring.transcript import Transcript
from autograder.authoring.walking.reports import require_error_code

PATH_TOLERANCE = 0.5  # rad
EARLY = 0.15  # rad less, at which a server may already see it
BEGUN = 0.3  # s that a server may have begun before its answer was seen
REACTION = 1.5  # s for the server to say so

_MERGE = (
    "The robot follows one trajectory at a time: a new message on joint_trajectory replaces the old one, also for the "
    "other arm. Publish one trajectory with what is left of both."
)


_SPARE = (
    "An empty trajectory holds both arms. While the other arm moves, publish what is left of its trajectory instead: "
    "the joints that it leaves out hold."
)
_WENT_ON = (
    "The old goal went on after the new one was accepted. How does its loop learn that it is no longer the arm's "
    "newest? (handle_accepted_callback)"
)


def require_path_violation(goal: Goal, joint: str) -> None:
    """Require that a goal whose joint was held is ABORTED once it is 0.5 rad off its trajectory, and not before."""
    plan = _held_plan(goal, joint)
    result = require_accepted(goal).require_result(
        ABORTED,
        help=f"{joint} was held. Compare joint_states with where the trajectory has each joint at that moment, in "
        "every round.",
    )
    held = goal.run.told("hold_joint", joint=joint).t
    off = max(
        abs(report.positions[joint] - plan.at(report.t)[joint])
        for report in joints_between(goal.run, held, result.t)
    )
    expect(
        off >= PATH_TOLERANCE - EARLY,
        expected=f"the goal to go on until {joint} is {PATH_TOLERANCE} rad off its trajectory",
        observed=f"it ended when {joint} was {off:.2f} rad off",
        help="An arm is always a little late. Abort only over 0.5 rad, and measure from where the trajectory has the "
        "joint now.",
        at=result.t,
    )
    late = result.t - max(held, _first_off(goal, plan, joint))
    expect(
        late <= REACTION,
        expected=f"the goal ABORTED as soon as {joint} is {PATH_TOLERANCE} rad off",
        observed=f"{late:.1f} s later",
        help="Look at the deviation in every round, not only at the end.",
        at=result.t,
    )
    require_error_code(
        goal,
        "PATH_TOLERANCE_VIOLATED",
        because=f"{joint} was held, and more than {PATH_TOLERANCE} rad off its trajectory",
    )


def _first_off(goal: Goal, plan: Plan, joint: str) -> float:
    """Return when (s) a joint was off its trajectory by the path's tolerance for the first time."""
    for report in joints_between(goal.run, plan.begin, goal.run.end):
        if abs(report.positions[joint] - plan.at(report.t)[joint]) >= PATH_TOLERANCE:
            return report.t
    raise unseen(goal.run, f"{joint} never was {PATH_TOLERANCE} rad off its trajectory")


def _held_plan(goal: Goal, joint: str) -> Plan:
    """Return the plan of a goal whose joint moved and was then held."""
    plan = plan_of(goal)
    held = goal.run.told("hold_joint", joint=joint)
    require_moving(goal.run, joint, held.t)
    return plan


def require_held_short(goal: Goal, joint: str) -> Plan:
    """Return the plan of a goal whose joint was short of its end, by more than the usual tolerance, when it was due."""
    plan = _held_plan(goal, joint)
    worst, error = largest(errors(joints_at(goal.run, plan.end).positions, plan.final()))
    if worst != joint or not GOAL_TOLERANCE < error < PATH_TOLERANCE:
        raise unseen(goal.run, f"{joint} was not held short of its end")
    return plan


def require_goal_violation(goal: Goal, joint: str) -> None:
    """Require that a goal whose joint was held short of its end is ABORTED a second after that, and not before."""
    plan = require_held_short(goal, joint)
    result = require_aborted(
        goal,
        "GOAL_TOLERANCE_VIOLATED",
        because=f"{joint} was held short of the last point",
        help="Succeed only when joint_states say that every joint is within goal_tolerance of the last point."
        if goal.result
        else "The goal never ended. 1 s after the last point's time_from_start, abort with GOAL_TOLERANCE_VIOLATED.",
    )
    expect(
        plan.end - BEGUN <= result.t <= plan.end + PATIENCE + REACTION,
        expected="the goal to end 1 s after its last point was due",
        observed=f"it ended {result.t - plan.end:+.1f} s after that",
        help="Wait for the last point's time_from_start, then at most 1 s for every joint to be within goal_tolerance.",
        at=result.t,
    )


def require_released_in_time(goal: Goal, joint: str) -> None:
    """Require that a joint was short of its end when that was due, and let go at once."""
    plan = require_held_short(goal, joint)
    released = goal.run.told("release_joint", joint=joint).t
    if released > plan.end + 0.6 * PATIENCE:
        raise unseen(goal.run, f"{joint} was let go too late")


def require_last_trajectory_empty(run: Transcript, by: float, until: float) -> None:
    """Require that the last trajectory published until `until` (s) came after `by` (s) and has no points."""
    published = [each for each in run.heard("joint_trajectory") if each.t <= until]
    if not published:
        raise unseen(run, "nobody heard anything on joint_trajectory")
    last = published[-1]
    message: JointTrajectory = last.message
    expect(
        last.t >= by and not message.points,
        expected="an empty JointTrajectory() on joint_trajectory, which means hold",
        observed="none after the cancel" if last.t < by else f"one with {len(message.points)} point(s)",
        help="Publish JointTrajectory() when is_cancel_requested, before canceled(). (While the other arm moves, what "
        "is left of its trajectory.)",
        at=last.t,
    )


def require_preempted(old: Goal, new: Goal, joint: str) -> None:
    """Require that a second goal for the same arm ABORTED the first with PREEMPTED, and was carried out."""
    require_accepted(old)
    require_accepted(
        new, help="The new goal was rejected while another moved the arm: accept it; the older one gives way."
    )
    require_moving(new.run, joint, new.sent.t)
    end = require_aborted(
        old,
        "PREEMPTED",
        because="a new goal has taken the arm",
        help=_WENT_ON,
        other_code=_WENT_ON,
    )
    expect(
        end.t >= new.sent.t,
        expected="the old goal to go on until the new one comes",
        observed=f"it ended {new.sent.t - end.t:.1f} s before",
        help="Abort with PREEMPTED only when another goal for the same arm has been accepted.",
        at=end.t,
    )
    require_arrival(new)


def require_both(left: Goal, right: Goal, elbow: str) -> None:
    """Require that two goals for two arms were carried out at the same time."""
    require_accepted(left)
    require_accepted(right, help="A goal for the right arm was rejected while the left one moved: accept it.")
    require_moving(right.run, elbow, right.sent.t)
    for goal in (right, left):
        require_arrival(goal, given_up=_MERGE)
    assert left.result
    assert right.result
    expect(
        right.result.t < left.result.t,
        expected="the right arm's goal, which is shorter, to end first",
        observed=f"it ended {right.result.t - left.result.t:.1f} s after the left arm's",
        help="One goal waits for the other. Execute them at the same time: no lock while an arm moves, and a "
        "MultiThreadedExecutor, or an async execute that awaits.",
        at=right.result.t,
    )


def require_spared(goal: Goal) -> None:
    """Require that an arm's goal was carried out though the other arm's was cancelled."""
    require_arrival(goal, given_up=_SPARE)
