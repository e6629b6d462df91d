"""The robot's modes have the numbers of its interface."""

from __future__ import annotations

import pytest

from humanoid_interfaces.msg import RobotState
from robot_sim.state import Mode


@pytest.mark.parametrize("mode", Mode)
def test_a_mode_has_the_number_of_its_name_in_the_interface(mode):
    assert getattr(RobotState, mode.name) == mode
