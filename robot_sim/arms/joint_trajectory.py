"""A motion of some joints through waypoints."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from robot_sim.model.joint_names import FINGERS, LEG, UPPER_BODY_JOINTS

MOVABLE = tuple(name for name in UPPER_BODY_JOINTS if not name.endswith(FINGERS))


@dataclass(frozen=True)
class Waypoint:
    """The positions of the joints at one moment of a trajectory.

    Attributes:
        time: s, after the start.
        positions: rad, one for each joint.
        velocities: rad/s, one for each joint, at that moment; empty: not given.
    """

    time: float
    positions: tuple[float, ...]
    velocities: tuple[float, ...] = ()


@dataclass(frozen=True)
class JointTrajectory:
    """Names of joints, and the waypoints through which they move, in the order of their times.

    Raises:
        ValueError: a joint cannot be moved, a list has a wrong length, a number is not finite, or times do not
            increase. The message says where, and what was expected.
    """

    joints: tuple[str, ...]
    waypoints: tuple[Waypoint, ...]

    def __post_init__(self) -> None:
        _check_joints(self.joints)
        earlier = -math.inf
        for number, waypoint in enumerate(self.waypoints):
            _check_waypoint(number, waypoint, len(self.joints))
            if waypoint.time < 0 or waypoint.time <= earlier:
                raise ValueError(
                    f"waypoint {number} is at {waypoint.time:g} s; times must not be negative and must increase"
                )
            earlier = waypoint.time


def _check_joints(joints: Sequence[str]) -> None:
    for name in joints:
        if name in MOVABLE:
            continue
        if any(name.endswith(part) for part in LEG):
            raise ValueError(f"joint {name!r} belongs to a leg, which the walking controller moves")
        if any(name.endswith(part) for part in FINGERS):
            raise ValueError(f"joint {name!r} is a finger; use the gripper's command")
        raise ValueError(f"joint {name!r} is not known; the joints are {', '.join(MOVABLE)}")
    if len(set(joints)) != len(joints):
        raise ValueError(f"a joint is named twice in {', '.join(joints)}")


def _check_waypoint(number: int, waypoint: Waypoint, joints: int) -> None:
    if len(waypoint.positions) != joints:
        raise ValueError(f"waypoint {number} has {len(waypoint.positions)} positions for {joints} joints")
    if waypoint.velocities and len(waypoint.velocities) != joints:
        raise ValueError(f"waypoint {number} has {len(waypoint.velocities)} velocities for {joints} joints")
    if not all(map(math.isfinite, (waypoint.time, *waypoint.positions, *waypoint.velocities))):
        raise ValueError(f"waypoint {number} has a number that is not finite")


class JointPath:
    """The motion along a trajectory from the present positions of the joints.

    It is interpolated as in ros2_controllers' joint trajectory controller: by cubics between waypoints with velocities
    (Hermite interpolation), otherwise by straight lines.

    Args:
        trajectory: the waypoints, at least one.
        positions, velocities: of its joints (n,) at time 0, rad and rad/s.
    """

    def __init__(
        self, trajectory: JointTrajectory, positions: Sequence[float], velocities: Sequence[float]
    ) -> None:
        start = Waypoint(0.0, tuple(positions), tuple(velocities))
        self._waypoints = [start, *trajectory.waypoints]
        self._segment = 0

    @property
    def duration(self) -> float:
        """Time of the last waypoint, s."""
        return self._waypoints[-1].time

    def at(self, time: float) -> list[float]:
        """Return the positions (n,) rad at `time` (s), after the end the last ones; `time` must never decrease."""
        while self._segment < len(self._waypoints) - 2 and time > self._waypoints[self._segment + 1].time:
            self._segment += 1
        before, after = self._waypoints[self._segment : self._segment + 2]
        if time >= after.time:
            return list(after.positions)
        span = after.time - before.time
        share = (time - before.time) / span
        if not after.velocities:
            return [q0 + share * (q1 - q0) for q0, q1 in zip(before.positions, after.positions, strict=True)]
        resting = [0.0] * len(after.positions)
        return [
            _hermite(share, span, *ends)
            for ends in zip(
                before.positions,
                after.positions,
                before.velocities or resting,
                after.velocities,
                strict=True,
            )
        ]


def _hermite(s: float, span: float, q0: float, q1: float, v0: float, v1: float) -> float:
    """Return the cubic of length `span` (s) at its share `s`."""
    a = 2 * (q0 - q1) + span * (v0 + v1)
    b = 3 * (q1 - q0) - span * (2 * v0 + v1)
    return q0 + s * (span * v0 + s * (b + s * a))


HOLD = JointTrajectory((), ())
