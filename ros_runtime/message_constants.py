"""Constants of messages, for code that checks or draws a record without loading ROS.

A test compares them with the constants in the messages.
"""

from __future__ import annotations

from enum import IntEnum


class GoalStatus(IntEnum):
    """The states of a goal, as in action_msgs/GoalStatus."""

    UNKNOWN = 0
    ACCEPTED = 1
    EXECUTING = 2
    CANCELING = 3
    SUCCEEDED = 4
    CANCELED = 5
    ABORTED = 6


class RobotMode(IntEnum):
    """The robot's modes, as in humanoid_interfaces/RobotState."""

    OFF = 0
    STANDING = 1
    WALKING = 2
    FALLEN = 3


def name_of(constants: type[IntEnum], value: int) -> str:
    """Return the name of the constant with this value, or the value as text: a node may send any value."""
    names = {int(constant): constant.name for constant in constants}
    return names.get(value, str(value))
