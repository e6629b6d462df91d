"""Forward kinematics of the planar two-link arm: the places of elbow and hand (m). x is forward, y is up."""

from __future__ import annotations

import math
from dataclasses import dataclass

Point = tuple[float, float]

TOLERANCE = 0.001  # m, of the hand at the target


@dataclass(frozen=True)
class TwoLinkArm:
    """The arm's lengths, in m.

    Angles are in rad, counter-clockwise: the upper arm's from the x axis, the forearm's from the upper arm.
    """

    upper_arm: float = 0.30
    forearm: float = 0.25

    def elbow_at(self, shoulder: float) -> Point:
        """Return the place of the elbow."""
        return self.upper_arm * math.cos(shoulder), self.upper_arm * math.sin(shoulder)

    def hand_at(self, shoulder: float, elbow: float) -> Point:
        """Return the place of the hand."""
        x, y = self.elbow_at(shoulder)
        return x + self.forearm * math.cos(shoulder + elbow), y + self.forearm * math.sin(shoulder + elbow)

    def hand_error(self, shoulder: float, elbow: float, target: Point) -> float:
        """Return the distance (m) from the hand to a point, or infinity if an angle is NaN or infinite."""
        if not math.isfinite(shoulder + elbow):
            return math.inf
        return math.dist(self.hand_at(shoulder, elbow), target)

    def elbow_is_above(self, shoulder: float, target: Point) -> bool:
        """Return whether the elbow lies above the line from the shoulder to a point ahead of it (x > 0)."""
        x, y = self.elbow_at(shoulder)
        return target[0] * y - target[1] * x > 0

    @property
    def parameters(self) -> dict[str, float]:
        """The lengths, by the names of the node's parameters."""
        return {"upper_arm_length": self.upper_arm, "forearm_length": self.forearm}

    @property
    def nearest(self) -> float:
        """The smallest possible distance (m) from the shoulder to the hand."""
        return abs(self.upper_arm - self.forearm)

    @property
    def farthest(self) -> float:
        """The largest possible distance (m) from the shoulder to the hand."""
        return self.upper_arm + self.forearm


DEFAULT = TwoLinkArm()
