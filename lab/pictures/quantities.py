"""The quantities that can be plotted: their units, and how they are read from messages."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from lab.errors import LabError
from robot_sim.model.joint_names import ACTUATED_JOINTS, FINGERS
from ros_runtime.angles import yaw_of


@dataclass(frozen=True)
class Quantity:
    """A measured quantity in `unit`, read from the messages of `topic`.

    The plot's axis spans at least `min_range`, so that noise does not look like a motion. `is_angle` means that the
    values wrap around at ±π.
    """

    topic: str
    unit: str
    min_range: float
    read: Callable[[Any], float]
    is_angle: bool = False


def _tilt(odometry: Any) -> float:
    q = odometry.pose.pose.orientation
    return math.acos(max(-1.0, min(1.0, 1.0 - 2.0 * (q.x * q.x + q.y * q.y))))


def _pitch(odometry: Any) -> float:
    q = odometry.pose.pose.orientation
    return math.asin(max(-1.0, min(1.0, 2.0 * (q.w * q.y - q.z * q.x))))


def _heading(odometry: Any) -> float:
    q = odometry.pose.pose.orientation
    return yaw_of(q.x, q.y, q.z, q.w)


QUANTITIES = {
    "x": Quantity("odom", "m", 0.1, lambda odometry: odometry.pose.pose.position.x),
    "y": Quantity("odom", "m", 0.1, lambda odometry: odometry.pose.pose.position.y),
    "speed": Quantity("odom", "m/s", 0.2, lambda odometry: odometry.twist.twist.linear.x),
    "sideways speed": Quantity("odom", "m/s", 0.2, lambda odometry: odometry.twist.twist.linear.y),
    "turn rate": Quantity("odom", "rad/s", 0.2, lambda odometry: odometry.twist.twist.angular.z),
    "height": Quantity("odom", "m", 0.1, lambda odometry: odometry.pose.pose.position.z),
    "heading": Quantity("odom", "rad", 0.2, _heading, is_angle=True),
    "pitch": Quantity("odom", "rad", 0.05, _pitch),
    "tilt": Quantity("odom", "rad", 0.2, _tilt),
    "grip": Quantity("r_gripper/wrench", "N", 5.0, lambda wrench: wrench.wrench.force.y),
    "cup height": Quantity("objects/cup/pose", "m", 0.1, lambda pose: pose.pose.position.z),
    "power": Quantity("battery_state", "W", 10.0, lambda battery: -battery.voltage * battery.current),
}


def quantity_named(name: str) -> Quantity:
    """Return a quantity by its name; the name of a joint stands for its position.

    Raises LabError when there is no such quantity; the message lists the names.
    """
    if name in ACTUATED_JOINTS:
        unit = "m" if name.endswith(FINGERS) else "rad"
        return Quantity("joint_states", unit, 0.2, lambda states: states.position[states.name.index(name)])
    if name not in QUANTITIES:
        known = ", ".join(f'"{each}" ({quantity.unit})' for each, quantity in QUANTITIES.items())
        raise LabError(
            f"there is no quantity {name!r}; the quantities are {known}, and the position of each joint by its name, "
            'such as "l_elbow" (rad)'
        )
    return QUANTITIES[name]
