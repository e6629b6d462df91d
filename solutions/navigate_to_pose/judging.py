"""What a navigation server tells on its way, compared with what the robot did in the simulator."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from builtin_interfaces.msg import Duration

from autograder.authoring import events as ev
from autograder.authoring.failure import expect
from autograder.authoring.feedback import require_feedback
from autograder.authoring.goal import SUCCEEDED, Goal
from autograder.authoring.missing import unseen
from autograder.authoring.walking.path import length_walked, walking_speed
from autograder.authoring.walking.planar import error, target
from ros_runtime.angles import wrap

FACING = 0.6  # rad between heading and goal while it walks
IN_PLACE, WALKS = 0.10, 0.20  # m/s of the body as a whole
TURNS = 0.15  # rad/s
LOST = 0.2  # m where the robot turns back: half a leg before it and half a leg after it go uncounted
SHARE, LEAST = 0.15, 0.25  # of the path, or m (more than a step), that distance_traveled may be off
TIME_SLACK = 1.0  # s that a reported time may be off: feedback's period and delivery
HALF_WAY = (25.0, 75.0)  # percent
COMPLETE = 99.5  # percent
FACTOR = 2.0
ON_THE_WAY = 0.3  # m left, at least, where the robot is under way
MOST_DETOURS = 3  # one is right; who counts the turn back and the walk back as two is right, too


@dataclass(frozen=True)
class Leg:
    """A goal that was reached, with the moment when half of its distance was left."""

    goal: Goal
    start: float  # s
    half: float  # s
    end: float  # s

    @staticmethod
    def of(goal: Goal) -> Leg:
        """Return the walk to a goal, which must have succeeded."""
        end = goal.require_accepted().require_result(SUCCEEDED).t
        start = goal.accepted_at
        whole, _turn = error(goal.run.robot_at(start), goal)
        for robot in goal.run.robot_between(start, end):
            if error(robot, goal)[0] <= whole / 2:
                return Leg(goal, start, robot.t, end)
        raise unseen(goal.run, f"the robot was never half way to “{goal.name}”")


def seconds(duration: Duration) -> float:
    """Return a duration in s."""
    return float(duration.sec + duration.nanosec * 1e-9)


def under_way(goal: Goal) -> Sequence[ev.FeedbackReceived]:
    """Return the feedback that came while more than 0.3 m were left, of which there must be some."""
    require_feedback(goal)
    far = [f for f in goal.feedback if error(goal.run.robot_at(f.t), goal)[0] > ON_THE_WAY]
    if not far:
        raise unseen(goal.run, f"the robot was never under way to “{goal.name}”")
    return far


def require_facing(goal: Goal) -> None:
    """Require that the robot faces the goal while it walks in the middle of its way."""
    leg = Leg.of(goal)
    for robot in goal.run.robot_between(leg.half - 1.0, leg.half + 0.5):
        if walking_speed(goal.run, robot.t) < IN_PLACE:
            continue
        pose = target(goal).position
        bearing = math.atan2(pose.y - robot.y, pose.x - robot.x)
        off = abs(wrap(robot.yaw - bearing))
        expect(
            off <= FACING,
            expected="the robot to turn toward the goal first, and to walk straight ahead",
            observed=f"it walks with its heading {off:.1f} rad off the goal",
            help="While the goal is farther than 0.3 m, publish angular.z alone until math.atan2(dy, dx) minus the "
            "heading is small; only then linear.x.",
            at=robot.t,
        )


def require_named_phases(goal: Goal) -> None:
    """Require that the walk has a name of its own, and the turns before and after it have others."""
    leg = Leg.of(goal)
    turning = _statuses(goal, leg.start, leg.half, lambda robot, speed: speed < IN_PLACE and _turns(robot))
    walking = _statuses(goal, leg.start, leg.end, lambda robot, speed: speed > WALKS)
    aligning = _statuses(goal, leg.half, leg.end, lambda robot, speed: speed < IN_PLACE and _turns(robot))
    for phase, statuses in (
        ("it turns toward the goal", turning),
        ("it walks", walking),
        ("it turns to the goal's heading", aligning),
    ):
        if not statuses:
            raise unseen(goal.run, f"no feedback came while {phase}")
        expect(
            all(status.strip() for status in statuses),
            expected=f"feedback.status to say in words that {phase}",
            observed="an empty status",
            help="Keep the phase in a variable, change it where the loop changes what it does, and copy it to "
            "feedback.status.",
        )
    names = [statuses.most_common(1)[0][0] for statuses in (turning, walking, aligning)]
    expect(
        names[1] not in (names[0], names[2]),
        expected="a status of its own for the walk, and others for the turns before and after it",
        observed=f"{names[0]!r} as it turns, {names[1]!r} as it walks, {names[2]!r} as it turns to the heading",
        help="Set the phase where the loop decides to turn, to walk or to align, and send that.",
        at=leg.half,
    )


def _turns(robot: ev.RobotTruth) -> bool:
    return abs(robot.turn_rate) > TURNS


def _statuses(goal: Goal, start: float, end: float, during) -> Counter[str]:
    """Count the statuses of the feedback between two moments while the robot did something."""
    run = goal.run
    return Counter(
        feedback.feedback.status
        for feedback in goal.feedback
        if start < feedback.t < end and during(run.robot_at(feedback.t), walking_speed(run, feedback.t))
    )


def require_measured_path(goal: Goal, end: ev.ResultReceived, reversals: int = 0) -> None:
    """Require that the result's distance_traveled is the length of the path, on which it turned back so many times."""
    walked = length_walked(goal.run, goal.accepted_at, end.t)
    claimed = float(end.result.distance_traveled)
    straight = math.dist(
        *((r.x, r.y) for r in (goal.run.robot_at(goal.accepted_at), goal.run.robot_at(end.t)))
    )
    if claimed > walked:
        help = (
            "The pelvis sways 3 cm to each side with every step, also while the robot turns on the spot. Count a leg "
            "only when odom is 0.15 m away from where the last one ended."
        )
    elif abs(claimed - straight) < LEAST / 2:
        help = (
            "That is the straight distance from start to end: add up the legs of the path, and the way back."
        )
    else:
        help = "Count the path in every round of the loop, from acceptance to the end, also while the robot turns."
    slack = max(SHARE * walked, LEAST)
    least, most = walked - slack - reversals * LOST, walked + slack
    expect(
        least <= claimed <= most,
        expected=f"result.distance_traveled near {walked:.2f} m ({least:.2f} to {most:.2f} m), the path of the pelvis "
        "without its sway",
        observed=f"{claimed:.2f} m",
        help=help,
        at=end.t,
    )


def require_rising_progress(goal: Goal) -> None:
    """Require that progress_percentage is 0 to 100, never falls, and is 100 when the goal has succeeded."""
    end = goal.require_accepted().require_result(SUCCEEDED)
    require_feedback(goal)
    before = 0.0
    for feedback in goal.feedback:
        progress = float(feedback.feedback.progress_percentage)
        expect(
            0.0 <= progress <= 100.01,
            expected="progress_percentage from 0 to 100",
            observed=f"{progress:g}",
            help="0/0 is NaN where nothing is left to walk, and a longer way than at first is below 0: clamp it.",
            at=feedback.t,
        )
        expect(
            progress >= before - 0.01,
            expected="progress_percentage never to fall",
            observed=f"{progress:.1f} after {before:.1f}",
            help="A detour makes the way longer, and sway does so with every step: publish the largest value so far.",
            at=feedback.t,
        )
        before = progress
    expect(
        before >= COMPLETE,
        expected="100 percent in the last feedback of a goal that SUCCEEDED",
        observed=f"{before:.1f}",
        help="Publish one more feedback with progress_percentage 100 before succeed().",
        at=end.t,
    )


def require_half_done_half_way(goal: Goal) -> None:
    """Require that the progress half way is about half."""
    leg = Leg.of(goal)
    progress = _at(goal, leg.half).feedback.progress_percentage
    low, high = HALF_WAY
    expect(
        low <= progress <= high,
        expected=f"progress_percentage from {low:.0f} to {high:.0f} where half of the distance is left",
        observed=f"{progress:.1f}",
        help="Compare what is left, in metres or in seconds, with what was left when the goal was accepted.",
        at=leg.half,
    )


def require_good_estimate(goal: Goal) -> None:
    """Require that the estimated time is positive under way, and within a factor of 2 half way."""
    leg = Leg.of(goal)
    for feedback in under_way(goal):
        estimate = seconds(feedback.feedback.estimated_time_remaining)
        expect(
            estimate > 0,
            expected="estimated_time_remaining above 0 while the robot is under way",
            observed=f"{estimate:.2f} s",
            help="Fill it in every feedback, with rclpy.duration.Duration(seconds=…).to_msg(): int seconds alone are 0 "
            "for the last second, and a speed of 0 divides by zero.",
            at=feedback.t,
        )
    estimate, left = seconds(_at(goal, leg.half).feedback.estimated_time_remaining), leg.end - leg.half
    expect(
        left / FACTOR <= estimate <= left * FACTOR,
        expected=f"estimated_time_remaining from {left / FACTOR:.1f} to {left * FACTOR:.1f} s half way, as it took "
        f"{left:.1f} s more",
        observed=f"{estimate:.1f} s",
        help="Divide what is left by the speed that the robot really has, and add the time of the last turn and of "
        "standing still."
        if estimate < left
        else "Divide what is left by the speed that the robot really has while it walks.",
        at=leg.half,
    )


def require_true_navigation_time(goal: Goal) -> None:
    """Require that navigation_time is the time since acceptance, until the goal has succeeded."""
    goal.require_accepted().require_result(SUCCEEDED)
    require_feedback(goal)
    start = goal.accepted_at
    told = _told(goal)
    if not told or told[-1].t - start < 2 * TIME_SLACK:
        raise unseen(goal.run, f"there was feedback on “{goal.name}” for a moment only")
    for feedback in told:
        claimed, true = seconds(feedback.feedback.navigation_time), feedback.t - start
        expect(
            abs(claimed - true) <= TIME_SLACK,
            expected=f"navigation_time near {true:.1f} s, since the goal was accepted",
            observed=f"{claimed:.1f} s",
            help="Remember when the goal is accepted, and subtract that: neither the node's start nor the phase's."
            if claimed
            else "Fill feedback.navigation_time from the time since the goal was accepted.",
            at=feedback.t,
        )


def require_no_detour(goal: Goal) -> None:
    """Require that no recovery is counted on a way without a disturbance."""
    require_feedback(goal)
    counted = max(goal.feedback, key=lambda feedback: feedback.feedback.number_of_recoveries)
    expect(
        counted.feedback.number_of_recoveries == 0,
        expected="number_of_recoveries 0: nothing disturbed the robot",
        observed=f"{counted.feedback.number_of_recoveries}",
        help="The turn at the start is no recovery, nor is a bearing that swings when the goal is a step away: count "
        "only when the robot walks, farther than 0.3 m from the goal, and is off by more than 0.5 rad.",
        at=counted.t,
    )


def require_led_astray(goal: Goal) -> tuple[float, float]:
    """Return when the robot was taken over and given back; it must then have been off its way by more than 0.5 rad."""
    run = goal.run
    taken, given = run.told("take_over", velocity=[-0.2, 0.0, 0.0]), run.told("take_over", velocity=None)
    place = target(goal).position
    robot = run.robot_at(given.t)
    off = abs(wrap(robot.yaw - math.atan2(place.y - robot.y, place.x - robot.x)))
    if off < FACING:
        raise unseen(run, f"the robot was only {off:.1f} rad off its way when it was given back")
    return taken.t, given.t


def require_detour_counted(goal: Goal) -> None:
    """Require that a recovery is counted once the robot has been led astray, and not before."""
    taken, given = require_led_astray(goal)
    require_feedback(goal)
    early = [f for f in goal.feedback if f.t < taken]
    counts = [f.feedback.number_of_recoveries for f in _told(goal)]
    expect(
        not early or early[-1].feedback.number_of_recoveries == 0,
        expected="number_of_recoveries 0 until something disturbs the robot",
        observed=f"{early[-1].feedback.number_of_recoveries if early else 0}",
        help="The turn at the start is no recovery.",
        at=taken,
    )
    if not counts:
        raise unseen(goal.run, f"there was no feedback on “{goal.name}” before its result")
    expect(
        1 <= counts[-1] <= MOST_DETOURS,
        expected="number_of_recoveries 1 after the robot was led astray once",
        observed=f"{counts[-1]}",
        help="Count where the walking phase changes back to turning, not in every round of the loop."
        if counts[-1]
        else "While it walks, compare the goal's bearing with the heading: beyond 0.5 rad go back to the turning phase "
        "and add 1.",
        at=given,
    )
    expect(
        sorted(counts) == counts,
        expected="number_of_recoveries never to fall",
        observed=f"{counts}",
        help="Count for the whole goal.",
        at=given,
    )


def _told(goal: Goal) -> list[ev.FeedbackReceived]:
    """Return the feedback until the result; what comes later is another check's business."""
    return [feedback for feedback in goal.feedback if goal.result is None or feedback.t <= goal.result.t]


def _at(goal: Goal, t: float) -> ev.FeedbackReceived:
    """Return the last feedback not later than a moment, or the first."""
    require_feedback(goal)
    return next((feedback for feedback in reversed(goal.feedback) if feedback.t <= t), goal.feedback[0])
