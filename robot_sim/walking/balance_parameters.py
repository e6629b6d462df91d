"""The gains of the whole-body controller."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class BalanceParameters:
    """Gains of the whole-body controller and limits of the contact forces."""

    stand_gain: float = 2.0  # of the DCM's error, while standing
    sole_length_share: float = 0.80  # share of the sole's half-length that the planned CoP may use
    sole_width_share: float = 0.75  # share of its half-width
    sole_edge_share: float = 0.90  # share of both that the commanded CoP may use
    tilt_stiffness: float = 120.0  # 1/s², roll and pitch unless other gains are given
    tilt_damping: float = 18.0  # 1/s
    yaw_stiffness: float = 80.0  # 1/s²
    yaw_damping: float = 14.0  # 1/s
    height_stiffness: float = 120.0  # 1/s²
    height_damping: float = 20.0  # 1/s
    yaw_rate: float = 2.0  # rad/s, limit for the heading reference
    swing_stiffness: float = 900.0  # 1/s²
    swing_damping: float = 60.0  # 1/s
    swing_turn_stiffness: float = 400.0  # 1/s²
    swing_turn_damping: float = 36.0  # 1/s
    stance_damping: float = 10.0  # 1/s
    momentum_iterations: int = 2
    min_load: float = 0.2  # share of the weight
    max_load: float = 2.5  # multiple of the weight
    friction: float = 0.7
    yaw_moment_per_load: float = 0.05  # m, yaw moment a foot may carry per N of its load
    cop_shift_filter: float = 0.7  # share of the filtered CoP shift that remains after cop_shift_period
    cop_shift_period: float = 0.004  # s
