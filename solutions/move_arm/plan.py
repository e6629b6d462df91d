"""The planned positions of the joints over time: the robot interpolates linearly between a trajectory's points."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Mapping
from dataclasses import dataclass

from trajectory_msgs.msg import JointTrajectory

from autograder.authoring.walking.obligations.reporting import seconds


@dataclass(frozen=True)
class Plan:
    """A trajectory that starts at the joints' positions when the goal was accepted.

    Attributes:
        joints: the names of the joints.
        begin: when it began, s.
        times: of each point, s after `begin`; the first is the start, at 0.
        places: the joints' positions at each point, rad; the first is the start.
    """

    joints: tuple[str, ...]
    begin: float
    times: tuple[float, ...]
    places: tuple[tuple[float, ...], ...]

    @classmethod
    def of(cls, trajectory: JointTrajectory, start: Mapping[str, float], begin: float) -> Plan:
        """Return the plan of a trajectory that begins at `begin` (s) with the joints at `start` (rad)."""
        joints = tuple(trajectory.joint_names)
        times = (0.0, *(seconds(point.time_from_start) for point in trajectory.points))
        here = tuple(start[joint] for joint in joints)
        return cls(joints, begin, times, (here, *(tuple(point.positions) for point in trajectory.points)))

    @property
    def end(self) -> float:
        """When (s) its last point is due."""
        return self.begin + self.times[-1]

    def at(self, t: float) -> dict[str, float]:
        """Return where the joints should be (rad) at a time (s)."""
        after = min(max(bisect_right(self.times, t - self.begin), 1), len(self.times) - 1)
        earlier, later = self.times[after - 1], self.times[after]
        share = min(max((t - self.begin - earlier) / (later - earlier), 0.0), 1.0)
        places = zip(self.joints, self.places[after - 1], self.places[after], strict=True)
        return {joint: before + share * (then - before) for joint, before, then in places}

    def point_at(self, t: float) -> int:
        """Return the index of the point that the arm moves to at a time (s)."""
        return min(max(bisect_right(self.times, t - self.begin) - 1, 0), len(self.times) - 2)

    def final(self) -> dict[str, float]:
        """Return the positions of the joints at the last point (rad)."""
        return dict(zip(self.joints, self.places[-1], strict=True))


def largest(errors: Mapping[str, float]) -> tuple[str, float]:
    """Return the joint with the largest error and that error."""
    worst = max(errors, key=lambda joint: errors[joint])
    return worst, errors[worst]


def errors(places: Mapping[str, float], wanted: Mapping[str, float]) -> dict[str, float]:
    """Return the distance (rad) of each joint in `wanted` from its wanted position."""
    return {joint: abs(places[joint] - place) for joint, place in wanted.items()}
