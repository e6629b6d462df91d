"""The state of a humanoid, as its methods return it."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

import numpy as np


class Mode(IntEnum):
    """What the robot is doing; the numbers are those of humanoid_interfaces/RobotState."""

    OFF = 0  # motors off: still upright, or collapsing
    STANDING = 1
    WALKING = 2
    FALLEN = 3  # motors off; only a reset gets it up


@dataclass(frozen=True)
class BasePose:
    """Pose of base_link (the pelvis) in the odom frame."""

    position: np.ndarray  # (3,) m
    quaternion: np.ndarray  # (4,) x, y, z, w
    yaw: float  # rad


@dataclass(frozen=True)
class ObjectPose:
    """Pose of an object's centre in the odom frame."""

    position: np.ndarray  # (3,) m
    quaternion: np.ndarray  # (4,) x, y, z, w


@dataclass(frozen=True)
class HandPose:
    """Pose of the point between a hand's pads in the odom frame: x along the fingers, y in their opening direction."""

    position: np.ndarray  # (3,) m
    quaternion: np.ndarray  # (4,) x, y, z, w


@dataclass(frozen=True)
class Wrench:
    """Force and torque on a foot, about its sole's centre: x ahead, y left, z up from the sole."""

    force: np.ndarray  # (3,) N
    torque: np.ndarray  # (3,) N·m


@dataclass(frozen=True)
class BaseVelocity:
    """Velocity of base_link, in base_link."""

    linear: np.ndarray  # (3,) m/s
    angular: np.ndarray  # (3,) rad/s


@dataclass(frozen=True)
class JointState:
    """The n actuated joints, in the order of the robot's `Body.joints`; fingers in m, m/s and N."""

    names: tuple[str, ...]
    position: np.ndarray  # (n,) rad
    velocity: np.ndarray  # (n,) rad/s
    effort: np.ndarray  # (n,) N·m


@dataclass(frozen=True)
class ImuSample:
    """The inertial sensor in the pelvis, axes as base_link (REP 145)."""

    orientation: np.ndarray  # (4,) x, y, z, w of imu_link in odom
    angular_velocity: np.ndarray  # (3,) rad/s
    linear_acceleration: np.ndarray  # (3,) m/s², +9.81 upwards at rest
