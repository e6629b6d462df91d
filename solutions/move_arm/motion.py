"""How an arm moves: it passes its points, stops when it has to, and stays where it is without a goal."""

from __future__ import annotations

from collections.abc import Sequence

from autograder.authoring import ABORTED, SUCCEEDED, Goal, Transcript, ev, expect, not_shown
from autograder.authoring.walking import life as goals

from . import life
from .endings import why_given_up
from .plan import errors, largest
from .truth import joints_at, joints_between, plan_of

PASSED = 0.2  # rad, of a point on the way
AROUND = 0.8  # s before and after the time at which a point is due
STILL = 0.05  # rad/s
STOP_TIME = 1.0  # s
WATCHED = 2.4  # s after the cancel
AT_LEAST = 0.5  # s of watching that prove something
GETTING_GOING = 0.5  # s
BRAKING = 0.5  # s
DRIFT = 0.1  # rad
SHORT = 0.25  # rad that a joint stays away from the end of a trajectory that was given up


def passes_every_point(goal: Goal) -> str | None:
    """The arm passes every point of the trajectory at about its time."""
    if not life.ends_by_itself(goal) or goals.was_not_awaited(goal) or life.hold_of(goal):
        return None
    plan = plan_of(goal)
    for number, places in enumerate(plan.places[1:]):
        due = plan.begin + plan.times[number + 1]
        wanted = dict(zip(plan.joints, places, strict=True))
        until = min(due + AROUND, life.next_for_the_arm(goal, goal.sent.t))
        seen = joints_between(goal.run, due - AROUND, max(until, due - AROUND))
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
    return f"{len(plan.times) - 1} points, {life.situation(goal)}"


def moves_until_canceled(goal: Goal) -> str | None:
    """The arm moves when the cancel comes."""
    asked = _first_cancel(goal)
    if asked is None or not goal.accepted_at + GETTING_GOING <= asked < plan_of(goal).end:
        return None
    if life.hold_of(goal):
        return None
    require_moving(goal, asked)
    return "on the way"


def stops_when_canceled(goal: Goal) -> str | None:
    """Within 1 s of the cancel the arm stands still."""
    asked = _first_cancel(goal)
    if asked is None or goals.successors(goal) or life.hold_of(goal):
        return None
    if not goals.granted(goal) and goal.status != SUCCEEDED:
        return None
    until = min(asked + WATCHED, life.next_for_the_arm(goal, asked))
    if until < asked + STOP_TIME + AT_LEAST:
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
        observed=f"{joint} turns at {fastest:.2f} rad/s {at - asked:.1f} s after the cancel",
        help="The robot follows a trajectory by itself to its end. Publish JointTrajectory() when the cancel is "
        "seen: an empty trajectory means hold.",
        at=at,
    )
    return "beside the other arm" if life.neighbours(goal) else "alone"


def stops_by_an_empty_trajectory(goal: Goal) -> str | None:
    """What stops a cancelled arm is an empty trajectory, unless the other arm moves."""
    asked = _first_cancel(goal)
    if asked is None or life.neighbours(goal) or goals.successors(goal) or not goals.granted(goal):
        return None
    run, until = goals.run_of(goal), goals.next_sent(goal, asked)
    published = [each for each in run.received("joint_trajectory") if each.t <= until]
    if not published:
        raise not_shown(run, "an empty trajectory stops the arm")
    last = published[-1]
    expect(
        last.t >= asked and not last.message.points,
        expected="an empty JointTrajectory() on joint_trajectory, which means hold",
        observed="none after the cancel"
        if last.t < asked
        else f"one with {len(last.message.points)} point(s)",
        help="Publish JointTrajectory() when is_cancel_requested, before canceled(). (While the other arm moves, what "
        "is left of its trajectory.)",
        at=last.t,
    )
    return "alone"


def holds_when_given_up(goal: Goal) -> str | None:
    """An arm that strayed from its path, or of which nothing is known any more, holds, also when nothing blocks it."""
    silent = life.is_carried_out(goal) and life.silent_since(goal) is not None
    if goal.status != ABORTED or not (
        silent or (life.ends_by_itself(goal) and life.fate_of(goal) is life.Fate.STRAYS)
    ):
        return None
    hold, until = life.hold_of(goal), life.next_for_the_arm(goal, goal.sent.t)
    since = goals.ended_at(goal) + BRAKING
    released = max(since, hold.until) if hold else since
    if until < released + AT_LEAST:
        return None
    before = joints_at(goal.run, since).positions
    for report in joints_between(goal.run, since, until):
        for joint, end in plan_of(goal).final().items():
            is_held = hold is not None and joint in hold.joints
            place = report.positions[joint]
            stays = report.t < released or abs(place - end) >= SHORT
            expect(
                stays if is_held else abs(place - before[joint]) <= DRIFT,
                expected="an arm that stays where it gave up, also when nothing blocks it any more",
                observed=f"{joint} went on, to {abs(place - end):.2f} rad before the end of the trajectory",
                help="The robot still follows the trajectory. Publish an empty JointTrajectory() before abort(): hold.",
                at=report.t,
            )
    return "without joint_states" if silent else "let go"


def stays_without_a_goal(run: Transcript) -> str | None:
    """An arm without a goal stays where it is."""
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
    """Require that the fastest joint of a goal moved shortly before a time (s); otherwise nothing has to stop."""
    places, then = plan_of(goal).at(at), plan_of(goal).at(at - AROUND)
    joint, _ = largest(errors(places, then))
    seen = joints_between(goal.run, at - AROUND, at)
    expect(
        max(abs(report.velocities[joint]) for report in seen) > 2 * STILL,
        expected="the arm under way by then",
        observed=f"{joint} does not move at {at:.1f} s",
        help="Publish the goal's trajectory on joint_trajectory as soon as the goal executes.",
        at=at,
    )


def _first_cancel(goal: Goal) -> float | None:
    """Return when (s) it was first asked to cancel an accepted goal that was active."""
    times = [cancel.sent.t for cancel in goals.requests_to_cancel(goal)] if life.is_carried_out(goal) else []
    return min((t for t in times if t < goals.ended_at(goal)), default=None)


def _require_rest(
    joints: Sequence[str], reports: Sequence[ev.JointsTruth], lives: Sequence[tuple[float, float]]
) -> None:
    """Require that joints do not move but in the lives (s, s) of their arm's goals."""
    rest = None
    for report in reports:
        if any(begin <= report.t <= end for begin, end in lives):
            rest = None
            continue
        rest = rest or report
        joint, moved = largest(errors(report.positions, {joint: rest.positions[joint] for joint in joints}))
        expect(
            moved <= DRIFT,
            expected=f"an arm that stays where it is without a goal, as since {rest.t:.1f} s",
            observed=f"{joint} turned by {moved:.2f} rad",
            help="Publish on joint_trajectory only what is left of the goals that are active: a rejected goal moves "
            "nothing, nor does one that has ended.",
            at=report.t,
        )
