"""The state that the robot's methods return."""

from __future__ import annotations

import math

import numpy as np
import pytest

from bench.robot.trial import simulate
from robot_sim.humanoid import Humanoid
from robot_sim.model.joint_names import ACTUATED_JOINTS


@pytest.fixture(scope="module")
def standing() -> Humanoid:
    humanoid = Humanoid()
    humanoid.reset(yaw=2.0)
    simulate(humanoid, 1.0)
    return humanoid


def test_joint_state_lists_every_actuated_joint(standing):
    state = standing.joint_state()
    assert list(state.names) == ACTUATED_JOINTS
    assert state.position.shape == state.velocity.shape == state.effort.shape == (34,)
    knees = [state.position[state.names.index(f"{side}_knee")] for side in "lr"]
    assert knees == pytest.approx([0.959, 0.959], abs=0.03)
    efforts = [state.effort[state.names.index(f"{side}_knee")] for side in "lr"]
    assert all(10 < abs(effort) < 60 for effort in efforts)


def test_imu_at_rest_shows_gravity_and_attitude(standing):
    sample = standing.imu()
    assert sample.linear_acceleration == pytest.approx([0, 0, 9.81], abs=0.15)
    assert sample.angular_velocity == pytest.approx([0, 0, 0], abs=0.02)
    assert sample.orientation == pytest.approx([0, 0, math.sin(1.0), math.cos(1.0)], abs=0.01)


def test_averaging_the_gyro_at_rest_finds_its_bias():
    humanoid = Humanoid(seed=11)
    simulate(humanoid, 1.0)
    readings = []
    for _ in range(400):
        humanoid.step()
        readings.append(humanoid.imu().angular_velocity)
    first, second = np.mean(readings[:200], axis=0), np.mean(readings[200:], axis=0)
    assert np.abs(first).max() > 5e-4
    assert second == pytest.approx(first, abs=3e-4)


def test_base_velocity_is_in_the_frame_of_the_base():
    humanoid = Humanoid()
    humanoid.reset(yaw=math.pi / 2)
    humanoid.walk_velocity(0.4, 0.0, 0.0)
    simulate(humanoid, 2.0)
    start = humanoid.base_pose().position
    forward = []
    for _ in range(176):
        humanoid.step()
        forward.append(humanoid.base_velocity().linear[0])
    walked = humanoid.base_pose().position - start
    assert walked[1] > 0.25
    assert np.mean(forward) * 176 * humanoid.timestep == pytest.approx(walked[1], rel=0.05)
