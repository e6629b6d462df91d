"""How an arm moved: whether it passed its points, reached the last one, and stood still when it had to."""

from __future__ import annotations

from autograder.authoring.arms.endings import GOAL_TOLERANCE, require_not_given_up, why_given_up
from autograder.authoring.arms.plan import errors, largest, speeds
from autograder.authoring.arms.truth import joints_at, joints_between, plan_of, require_accepted
from autograder.authoring.failure import Failure, expect
from autograder.authoring.goal import ABORTED, SUCCEEDED, Goal
from autograder.authoring.robot_record import RobotRecord

MEASURED = 0.02  # rad more, for what joint_states were when the server looked
PASSED = 0.2  # rad, of a point on the way
AROUND = 0.8  # s before and after the time at which a point is due
EARLY = 0.5  # s that a server may have begun before its answer was seen
STILL = 0.05  # rad/s
STOP_TIME = 1.0  # s
WATCHED = 2.4  # s after the cancel
STARTED = 0.1  # rad


def require_arrival(goal: Goal, given_up: str = "") -> None:
    """Require that the goal succeeded when every joint was at its last point, and no earlier.

    Args:
        goal: that can be carried out.
        given_up: what to do if the server aborts it, and nothing in the record says more.
    """
    require_not_given_up(require_accepted(goal), given_up)
    result = goal.require_result(SUCCEEDED)
    plan = plan_of(goal)
    expect(
        result.t >= plan.end - EARLY,
        expected="the goal to go on until its last point is due",
        observed=f"it SUCCEEDED {plan.end - result.t:.1f} s before",
        help="The arm may come by its last point on the way. Wait until the last point's time_from_start is over.",
        at=result.t,
    )
    tolerance = goal.request.goal_tolerance or GOAL_TOLERANCE
    joint, error = largest(errors(joints_at(goal.run, result.t).positions, plan.final()))
    expect(
        error <= tolerance + MEASURED,
        expected=f"every joint within {tolerance:.2f} rad of the last point when the goal SUCCEEDED",
        observed=f"{joint} is {error:.2f} rad away in the simulator",
        help="Wait until the last point's time_from_start is over, then compare joint_states with its positions, "
        "joint by joint, before succeed().",
        at=result.t,
    )


def require_points_passed(goal: Goal) -> None:
    """Require that every joint came by every point on the way, at about its time."""
    plan = plan_of(goal)
    for number, places in enumerate(plan.places[1:]):
        due = plan.due(number)
        wanted = dict(zip(plan.joints, places, strict=True))
        seen = joints_between(goal.run, due - AROUND, min(due + AROUND, goal.run.end))
        joint, error = min(
            (largest(errors(each.positions, wanted)) for each in seen), key=lambda pair: pair[1]
        )
        expect(
            error <= PASSED,
            expected=f"the arm at point {number} about {plan.times[number + 1]:.1f} s after the acceptance",
            observed=f"{joint} came no nearer than {error:.2f} rad",
            help=why_given_up(goal)
            if goal.status == ABORTED
            else "Publish the whole trajectory once on joint_trajectory, with every point and its time_from_start.",
            at=due,
        )


def require_moving(run: RobotRecord, joint: str, at: float) -> None:
    """Require that a joint moved shortly before a time (s); otherwise nothing has to stop."""
    seen = joints_between(run, at - 0.6, at)
    expect(
        speeds([report.velocities[joint] for report in seen]) > 2 * STILL,
        expected="the arm under way by then",
        observed=f"{joint} does not move at {at:.1f} s",
        help="Publish the goal's trajectory on joint_trajectory as soon as the goal executes.",
        at=at,
    )


def require_stopped(run: RobotRecord, joints: list[str], since: float) -> None:
    """Require that joints stand still from 1 s after `since` (s) on."""
    fastest, joint, at = max(
        (abs(report.velocities[joint]), joint, report.t)
        for report in joints_between(run, since + STOP_TIME, since + WATCHED)
        for joint in joints
    )
    if fastest >= STILL:
        raise Failure(
            expected=f"the arm slower than {STILL:.2f} rad/s within {STOP_TIME:.0f} s of the cancel, and still from "
            "then on",
            observed=f"{joint} turns at {fastest:.2f} rad/s {at - since:.1f} s after the cancel",
            help="The robot follows a trajectory by itself to its end. Publish JointTrajectory() when the cancel is "
            "seen: an empty trajectory means hold.",
            at=at,
        )


def require_stayed_short(goal: Goal, joint: str, *, by: float, since: float, until: float) -> None:
    """Require that a joint did not go on to the goal's last point: it stayed `by` (rad) away from it.

    Args:
        goal: that was given up.
        joint: its name.
        by: rad.
        since: s, from when on nothing holds the arm any more.
        until: s, how long it is watched.
    """
    end = plan_of(goal).final()[joint]
    nearest = min(abs(report.positions[joint] - end) for report in joints_between(goal.run, since, until))
    expect(
        nearest >= by,
        expected="an arm that stays where it gave up, also when nothing blocks it any more",
        observed=f"{joint} went on until {nearest:.2f} rad before the end of the trajectory",
        help="The robot still follows the trajectory. Publish an empty JointTrajectory() before abort(): hold.",
        at=until,
    )
