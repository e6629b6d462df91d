"""How an arm moves: it passes its points, stops when it has to, and stays still without a goal."""

from __future__ import annotations

from collections.abc import Sequence

from autograder.authoring import ABORTED, SUCCEEDED, Goal, Transcript, ev, expect, not_shown
from autograder.authoring.walking import life as goals

from . import life
from .endings import why_given_up
from .plan import errors, largest
from .truth import joints_at, joints_between, plan_of

POINT_TOLERANCE = 0.2  # rad
POINT_TIME_SLACK = 0.8  # s before and after a point is due
STILL = 0.05  # rad/s
STOP_TIME = 1.0  # s
OBSERVATION_TIME = 2.4  # s after a cancel
MIN_OBSERVATION = 0.5  # s; a shorter observation proves nothing
START_TIME = 0.5  # s
BRAKING_TIME = 0.5  # s
MAX_DRIFT = 0.1  # rad
MIN_DISTANCE_LEFT = 0.25  # rad from the end of an aborted trajectory, within which a joint must not come


def passes_every_point(goal: Goal) -> str | None:
    """The arm passes every point of the trajectory when it is due."""
    if not life.ends_by_itself(goal) or goals.was_not_awaited(goal) or life.hold_of(goal):
        return None
    plan = plan_of(goal)
    for number, places in enumerate(plan.places[1:]):
        due = plan.begin + plan.times[number + 1]
        wanted = dict(zip(plan.joints, places, strict=True))
        until = min(due + POINT_TIME_SLACK, life.next_for_the_arm(goal, goal.sent.t))
        seen = joints_between(goal.run, due - POINT_TIME_SLACK, max(until, due - POINT_TIME_SLACK))
        joint, error = min(
            (largest(errors(each.positions, wanted)) for each in seen), key=lambda pair: pair[1]
        )
        expect(
            error <= POINT_TOLERANCE,
            expected=f"the arm at point {number} about {plan.times[number + 1]:.1f} s after the goal was accepted",
            observed=f"{joint} came no nearer to it than {error:.2f} rad",
            help=why_given_up(goal)
            if goal.status == ABORTED
            else "Publish the whole trajectory once on joint_trajectory, with every point and its time_from_start.",
            at=due,
        )
    return f"{len(plan.times) - 1} points, {life.situation(goal)}"


def moves_until_canceled(goal: Goal) -> str | None:
    """The arm is moving when the cancel comes."""
    asked = _first_cancel(goal)
    if asked is None or not goal.accepted_at + START_TIME <= asked < plan_of(goal).end:
        return None
    if life.hold_of(goal):
        return None
    require_moving(goal, asked)
    return "on the way"


def stops_when_canceled(goal: Goal) -> str | None:
    """The arm is still within 1 s of the cancel."""
    asked = _first_cancel(goal)
    if asked is None or goals.successors(goal) or life.hold_of(goal):
        return None
    if not goals.granted(goal) and goal.status != SUCCEEDED:
        return None
    until = min(asked + OBSERVATION_TIME, life.next_for_the_arm(goal, asked))
    if until < asked + STOP_TIME + MIN_OBSERVATION:
        return None
    joints = goal.request.trajectory.joint_names
    fastest, joint, at = max(
        (abs(report.velocities[joint]), joint, report.t)
        for report in joints_between(goal.run, asked + STOP_TIME, until)
        for joint in joints
    )
    expect(
        fastest < STILL,
        expected=f"the arm slower than {STILL:.2f} rad/s within {STOP_TIME:.0f} s of the cancel, and still from "
        "then on",
        observed=f"{joint} turned at {fastest:.2f} rad/s {at - asked:.1f} s after the cancel",
        help="The robot follows a trajectory to its end unless you replace it. When is_cancel_requested is true, "
        "publish an empty JointTrajectory(), which stops the arm.",
        at=at,
    )
    return "together with the other arm" if life.neighbours(goal) else "alone"


def stops_by_an_empty_trajectory(goal: Goal) -> str | None:
    """After a cancel the server publishes an empty trajectory, unless the other arm moves."""
    asked = _first_cancel(goal)
    if asked is None or life.neighbours(goal) or goals.successors(goal) or not goals.granted(goal):
        return None
    run, until = goals.run_of(goal), goals.next_sent(goal, asked)
    published = [each for each in run.received("joint_trajectory") if each.t <= until]
    if not published:
        raise not_shown(run, "an empty trajectory was published")
    last = published[-1]
    expect(
        last.t >= asked and not last.message.points,
        expected="an empty JointTrajectory() on joint_trajectory, which stops the arm",
        observed="none after the cancel"
        if last.t < asked
        else f"one with {len(last.message.points)} point(s)",
        help="When is_cancel_requested is true, publish an empty JointTrajectory() before canceled(). While the other "
        "arm moves, publish the remaining points of its trajectory instead.",
        at=last.t,
    )
    return "alone"


def holds_when_given_up(goal: Goal) -> str | None:
    """After PATH_TOLERANCE_VIOLATED or INVALID_JOINTS the arm stays where it is, also when its joint is released."""
    silent = life.is_carried_out(goal) and life.silent_since(goal) is not None
    if goal.status != ABORTED or not (
        silent or (life.ends_by_itself(goal) and life.fate_of(goal) is life.Fate.STRAYS)
    ):
        return None
    hold, until = life.hold_of(goal), life.next_for_the_arm(goal, goal.sent.t)
    since = goals.ended_at(goal) + BRAKING_TIME
    released = max(since, hold.until) if hold else since
    if until < released + MIN_OBSERVATION:
        return None
    before = joints_at(goal.run, since).positions
    for report in joints_between(goal.run, since, until):
        for joint, end in plan_of(goal).final().items():
            is_held = hold is not None and joint in hold.joints
            place = report.positions[joint]
            stays = report.t < released or abs(place - end) >= MIN_DISTANCE_LEFT
            expect(
                stays if is_held else abs(place - before[joint]) <= MAX_DRIFT,
                expected="the arm to stay where it was when the goal was ABORTED, also when nothing blocks it any more",
                observed=f"{joint} moved on, to {abs(place - end):.2f} rad from the end of the trajectory",
                help="The robot still follows the trajectory. Before abort(), publish an empty JointTrajectory(), "
                "which stops the arm.",
                at=report.t,
            )
    return "without joint_states" if silent else "released"


def stays_without_a_goal(run: Transcript) -> str | None:
    """An arm without an active goal does not move."""
    reports = run.all(ev.JointsTruth)
    if not reports or not run.goals:
        return None
    held = {each.command.get("joint") for each in run.all(ev.RobotCommanded)}
    for arm in ("l_", "r_"):
        joints = [joint for joint in reports[0].positions if joint.startswith(arm) and joint not in held]
        own = [goal for goal in run.goals if goal.request.arm == arm[0] and goals.accepted(goal)]
        _require_rest(joints, reports, [(goal.sent.t, goals.ended_at(goal) + STOP_TIME) for goal in own])
    return "all the time"


def require_moving(goal: Goal, at: float) -> None:
    """Require that a goal's arm was moving shortly before a time (s); otherwise the scenario tests nothing."""
    places, then = plan_of(goal).at(at), plan_of(goal).at(at - POINT_TIME_SLACK)
    joint, _ = largest(errors(places, then))
    seen = joints_between(goal.run, at - POINT_TIME_SLACK, at)
    expect(
        max(abs(report.velocities[joint]) for report in seen) > 2 * STILL,
        expected=f"the arm moving {at - goal.accepted_at:.1f} s after the goal was accepted",
        observed=f"{joint} did not move",
        help="Publish the goal's trajectory on joint_trajectory as soon as the goal executes.",
        at=at,
    )


def _first_cancel(goal: Goal) -> float | None:
    """Return when (s) the first cancel request was sent while an accepted goal was active."""
    times = [cancel.sent.t for cancel in goals.requests_to_cancel(goal)] if life.is_carried_out(goal) else []
    return min((t for t in times if t < goals.ended_at(goal)), default=None)


def _require_rest(
    joints: Sequence[str], reports: Sequence[ev.JointsTruth], lives: Sequence[tuple[float, float]]
) -> None:
    """Require that joints move only while a goal of their arm is active, between the times (s, s) in `lives`."""
    rest = None
    for report in reports:
        if any(begin <= report.t <= end for begin, end in lives):
            rest = None
            continue
        rest = rest or report
        joint, moved = largest(errors(report.positions, {joint: rest.positions[joint] for joint in joints}))
        expect(
            moved <= MAX_DRIFT,
            expected=f"an arm that does not move without an active goal, from {rest.t:.1f} s on",
            observed=f"{joint} turned by {moved:.2f} rad",
            help="On joint_trajectory publish only remaining points of active goals, none of a goal that was rejected "
            "or has ended.",
            at=report.t,
        )
