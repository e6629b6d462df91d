"""The constants in message_constants.py equal those of the messages."""

from __future__ import annotations

from typing import Any

import pytest

pytest.importorskip("rclpy")

from action_msgs.msg import GoalStatus as GoalStatusMessage

from humanoid_interfaces.msg import RobotState
from ros_runtime.message_constants import GoalStatus, RobotMode, name_of


def constants_of(message: Any, prefix: str = "") -> dict[str, int]:
    """The integer constants that a message defines, by name."""
    named = {
        name: getattr(message, name) for name in dir(message) if name.startswith(prefix) and name.isupper()
    }
    return {name.removeprefix(prefix): value for name, value in named.items() if isinstance(value, int)}


def test_the_states_of_a_goal_are_those_of_the_message() -> None:
    assert {status.name: status.value for status in GoalStatus} == constants_of(GoalStatusMessage, "STATUS_")


def test_the_modes_of_the_robot_are_those_of_the_message() -> None:
    assert {mode.name: mode.value for mode in RobotMode} == constants_of(RobotState)


def test_a_value_without_a_name_is_shown_as_it_is() -> None:
    assert name_of(GoalStatus, 5) == "CANCELED"
    assert name_of(GoalStatus, 99) == "99"
