"""The gyro's bias: whether a vector is near it, and what kind of mistake makes one that is not."""

from __future__ import annotations

import math
from collections.abc import Sequence

from autograder.authoring import events as ev
from autograder.authoring.call import Call

TOLERANCE = 0.001  # rad/s
GRAVITY = 9.81  # m/s²


def imu_between(call: Call, start: float, end: float) -> list[ev.ImuPublished]:
    """Return what the robot published on imu between two times (s)."""
    return [sample for sample in call.run.all(ev.ImuPublished) if start <= sample.t <= end]


def advice_on_vector(call: Call, triples: Sequence[Sequence[float]], bias: Sequence[float]) -> str | None:
    """Return what kind of mistake makes one of the triples of the bias, if it is known."""
    now = imu_between(call, call.sent.t, call.answered.t)
    earlier = [event.command["bias"] for event in call.run.all(ev.RobotCommanded) if "bias" in event.command]
    for triple in triples:
        if is_near([value / max(len(now), 1) for value in triple], bias, TOLERANCE / 5):
            return "These are the sums: divide them by the number of samples."
        if is_near([value / 57.29578 for value in triple], bias, TOLERANCE / 5):
            return "These are degrees: imu tells rad/s, and so do you."
        if is_near([-value for value in triple], bias):
            return "The signs are the wrong way round: the bias is the mean itself."
        if is_near(sorted(triple), sorted(bias)):
            return "The values are right, but not in the order x, y, z."
        if math.dist(triple, (0.0, 0.0, GRAVITY)) < 2.0:
            return "These are accelerations: take angular_velocity of each message."
        if any(_is_mixed(triple, bias, other) for other in earlier[:-1]):
            return "Samples of before are in it: begin with an empty list each time, when get_status has answered."
        if not any(triple):
            return "A mean of exactly 0 comes from no sample: average what on_imu has collected."
    return None


def is_near(found: Sequence[float], bias: Sequence[float], tolerance: float = TOLERANCE) -> bool:
    """Return whether each component is within the tolerance (rad/s)."""
    return all(abs(one - other) <= tolerance for one, other in zip(found, bias, strict=True))


def _is_mixed(found: Sequence[float], bias: Sequence[float], other: Sequence[float]) -> bool:
    """Return whether it is a mean of samples of two biases (rad/s), or of the other alone."""
    way = [one - two for one, two in zip(bias, other, strict=True)]
    if not any(way):
        return False
    share = _dot(way, [one - two for one, two in zip(found, other, strict=True)]) / _dot(way, way)
    return 0.0 <= share <= 1.0 and is_near(
        found, [two + share * step for two, step in zip(other, way, strict=True)]
    )


def _dot(one: Sequence[float], two: Sequence[float]) -> float:
    return sum(a * b for a, b in zip(one, two, strict=True))


def xyz(vector: object) -> tuple[float, float, float]:
    """Return the components of a geometry_msgs/Vector3."""
    return vector.x, vector.y, vector.z  # type: ignore[attr-defined]


def shown_vector(vector: Sequence[float]) -> str:
    """Return a vector as it is shown in a report."""
    return "(" + ", ".join(f"{value:.4f}" for value in vector) + ")"
