"""Attitude errors in plain floats. Rotation matrices are nine numbers, row by row."""

from __future__ import annotations

from collections.abc import Sequence

Vector = tuple[float, float, float]


def upright_error(rotation: Sequence[float], cos_yaw: float, sin_yaw: float) -> Vector:
    """Return the rotation vector (rad, world frame, small angles) from `rotation` to upright with the given yaw.

    ½ vee(E - Eᵀ) of E = R_wanted Rᵀ: its length is the sine of the angle.
    """
    r00, r01, r02, r10, r11, r12, r20, r21, _ = rotation
    return (
        0.5 * (r12 - sin_yaw * r20 - cos_yaw * r21),
        0.5 * (cos_yaw * r20 - sin_yaw * r21 - r02),
        0.5 * (sin_yaw * r00 + cos_yaw * r01 - cos_yaw * r10 + sin_yaw * r11),
    )


def to_body(rotation: Sequence[float], vector: Vector) -> Vector:
    """Return a world vector in the frame of the body with this rotation."""
    x, y, z = vector
    return (
        rotation[0] * x + rotation[3] * y + rotation[6] * z,
        rotation[1] * x + rotation[4] * y + rotation[7] * z,
        rotation[2] * x + rotation[5] * y + rotation[8] * z,
    )


def to_world(rotation: Sequence[float], vector: Vector) -> Vector:
    """Return a vector of the body with this rotation in the world frame."""
    x, y, z = vector
    return (
        rotation[0] * x + rotation[1] * y + rotation[2] * z,
        rotation[3] * x + rotation[4] * y + rotation[5] * z,
        rotation[6] * x + rotation[7] * y + rotation[8] * z,
    )
