"""What the robot did, in the simulator or as simulated by the scenario, and what happened to it during a goal."""

from __future__ import annotations

import math
from dataclasses import dataclass

from autograder.authoring import Goal, Transcript, ev, fall_after, unseen
from autograder.authoring.walking.life import accepted, ended_at, granted, interrupted, next_sent, run_of

STANCE, RISEN = 0.60, 0.59  # m, heights of the pelvis
HEIGHT_SLACK = 0.005  # m
GAIN = 0.02  # m, by which the height of a pelvis that should stay may still change
UNEVEN = 0.6  # of the larger load
STILL, UPRIGHT = 0.035, 0.06  # m/s, rad; the task says 0.02 and 0.05
CAN_RISE = 6.0  # s, the longest that the robot needs to stand up from any crouch
TIME_LIMIT, EARLY, LATE = 12.0, 0.7, 2.5  # s
WEAK = "never_get_up"  # the scenario in which the robot is too weak to rise


@dataclass(frozen=True)
class Body:
    """The state of base_link at a time: its height (m), speed in any direction (m/s), and tilt (rad)."""

    t: float
    z: float
    speed: float
    tilt: float

    @property
    def unrest(self) -> str:
        """Why it has not settled, or ''."""
        if self.z < RISEN - HEIGHT_SLACK:
            return f"at {self.z:.3f} m"
        if self.speed > STILL:
            return f"moving at {self.speed:.2f} m/s"
        return f"tilted by {self.tilt:.2f} rad" if self.tilt > UPRIGHT else ""


def bodies(run: Transcript, begin: float, end: float) -> list[Body]:
    """Return the states of base_link between two times (s); there must be some."""
    if run.ground_truth:
        return [
            Body(robot.t, robot.z, math.hypot(robot.speed, climb(run, robot.t)), _tilt(robot.up))
            for robot in run.robot_between(begin, max(begin, end))
        ]
    found = []
    for each in run.published("odom"):
        if begin <= each.t <= end:
            pose, velocity = each.message.pose.pose, each.message.twist.twist.linear
            speed = math.hypot(velocity.x, velocity.y, velocity.z)
            up = 1.0 - 2.0 * (pose.orientation.x**2 + pose.orientation.y**2)
            found.append(Body(each.t, pose.position.z, speed, _tilt(up)))
    if not found:
        raise unseen(run, f"the robot's state at {end:.1f} s is unknown")
    return found


def _tilt(up: float) -> float:
    """Return the angle (rad) between the vertical and a unit vector whose vertical component is `up`."""
    return math.acos(max(-1.0, min(1.0, up)))


def climb(run: Transcript, t: float) -> float:
    """Return the vertical speed (m/s) of the simulator's pelvis around a time (s)."""
    earlier, later = run.robot_at(t - 0.06), run.robot_at(t + 0.06)
    return (later.z - earlier.z) / max(later.t - earlier.t, 0.02)


def height_at(run: Transcript, t: float) -> float:
    """Return the height (m) of base_link at a time (s)."""
    return bodies(run, t - 0.2, t)[-1].z


def loads(run: Transcript, begin: float, end: float) -> list[ev.FeetTruth]:
    """Return the loads on the feet between two times (s); empty if they were not recorded."""
    if run.ground_truth:
        return [each for each in run.all(ev.FeetTruth) if begin <= each.t <= end]
    left, right = (
        [each for each in run.published(f"{side}_foot/wrench") if begin <= each.t <= end] for side in "lr"
    )
    return [
        ev.FeetTruth(t=one.t, left=one.message.wrench.force.z, right=other.message.wrench.force.z)
        for one, other in zip(left, right, strict=False)
    ]


def share(feet: ev.FeetTruth) -> float:
    """Return the smaller load over the larger."""
    return max(0.0, min(feet.left, feet.right)) / max(feet.left, feet.right, 1.0)


def uneven_spans(run: Transcript, begin: float, end: float, least: float) -> list[tuple[float, float]]:
    """Return the begin and end (s) of each time in which the loads were uneven for at least `least` s."""
    spans: list[tuple[float, float]] = []
    since = None
    for each in [*loads(run, begin, end), ev.FeetTruth(t=math.inf, left=1.0, right=1.0)]:
        if share(each) < UNEVEN:
            since = each.t if since is None else since
            last = each.t
        elif since is not None:
            if last - since >= least:
                spans.append((since, last))
            since = None
    return spans


# -- what happened during a goal --------------------------------------------------------------------------------------


def began_low(goal: Goal) -> bool:
    """Return whether the robot certainly crouched, on its feet, when the goal was accepted."""
    run = run_of(goal)
    return accepted(goal) and height_at(run, goal.accepted_at) < RISEN - 0.01 and not lay_on_the_floor(goal)


def began_high(goal: Goal) -> bool:
    """Return whether the robot certainly stood when the goal was sent."""
    robots = goal.run.robot_between(goal.sent.t - 0.5, goal.sent.t) if goal.run.ground_truth else []
    return bool(robots) and all(robot.z >= RISEN for robot in robots) and not lay_on_the_floor(goal)


def lay_on_the_floor(goal: Goal) -> bool:
    """Return whether the robot had fallen before the goal was sent."""
    fallen = fall_after(goal.run, 0.0) if goal.run.ground_truth else None
    return fallen is not None and fallen.t < goal.sent.t


def fallen_during(goal: Goal) -> ev.RobotTruth | None:
    """Return the first sample of a fallen robot between the goal's acceptance and the next goal, or None."""
    fallen = fall_after(goal.run, goal.accepted_at) if goal.run.ground_truth else None
    return fallen if fallen and fallen.t <= next_sent(goal, goal.sent.t) else None


def lifetime(goal: Goal) -> tuple[float, float]:
    """Return the begin and end (s) of an accepted goal."""
    return goal.accepted_at, min(ended_at(goal), goal.run.end)


def pushes(run: Transcript) -> list[tuple[float, float]]:
    """Return the begin and end (s) of each time the scenario pushed the robot or leaned on it."""
    return [(each.t, each.t + each.command.get("duration", 0.0)) for each in run.commands("push")]


def was_pushed(goal: Goal) -> bool:
    """Return whether the scenario pushed the robot, or leaned on it, while the goal was active."""
    if not accepted(goal):
        return False
    begin, end = lifetime(goal)
    return any(first <= end and last >= begin for first, last in pushes(run_of(goal)))


def was_held(goal: Goal) -> bool:
    """Return whether the robot could not rise, as the scenario held it down or simulated one that is too weak."""
    before = [each for each in goal.run.commands("take_over") if each.t <= goal.accepted_at]
    return goal.run.scenario == WEAK or bool(before and before[-1].command.get("velocity") is not None)


def could_rise(goal: Goal) -> bool:
    """Return whether no cancel, fall, hold, Ctrl-C or uneven load kept the robot from rising in time."""
    if not began_low(goal) or was_held(goal) or granted(goal) or fallen_during(goal) or interrupted(goal):
        return False
    spans = uneven_spans(run_of(goal), *lifetime(goal), 0.1)
    return not spans or spans[-1][1] < goal.accepted_at + TIME_LIMIT - CAN_RISE
