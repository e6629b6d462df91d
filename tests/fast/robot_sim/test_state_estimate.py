"""Walking by IMU, encoders and contacts, without the simulator's ground truth."""

import numpy as np
import pytest

from bench.robot.state_estimate import StateEstimate
from bench.robot.trial import feet_midpoint, simulate
from bench.robot.trial_humanoid import TrialHumanoid
from robot_sim.sensors.imu import Imu
from robot_sim.state import Mode


def test_it_walks_to_a_goal_by_its_own_sensors():
    humanoid = TrialHumanoid(seed=2, estimates_state=True)
    simulate(humanoid, 1.0)
    humanoid.walk_to(0.6, 0.3, 0.5)
    assert simulate(humanoid, 15.0, until=lambda: humanoid.arrived)
    simulate(humanoid, 1.0)
    assert humanoid.mode is Mode.STANDING
    assert feet_midpoint(humanoid) == pytest.approx([0.6, 0.3], abs=0.06)


def test_the_estimate_follows_the_robot_through_a_walk():
    humanoid = TrialHumanoid(seed=3)
    estimate = StateEstimate(humanoid.model, humanoid.data, Imu(humanoid.model, humanoid.data, 3))
    position, velocity = [], []

    def step():
        humanoid.step()
        estimate.tick(humanoid.timestep)
        position.append(estimate.data.qpos[:3] - humanoid.data.qpos[:3])
        velocity.append(estimate.data.qvel[:3] - humanoid.data.qvel[:3])

    for _ in range(200):
        step()
    humanoid.walk_velocity(0.3, 0.0, 0.3)
    for _ in range(1200):
        step()
    assert np.abs(position).max() < 0.08
    assert np.abs(np.array(position)[:, 2]).max() < 0.01  # the feet determine the height
    assert np.sqrt(np.mean(np.square(velocity))) < 0.03


def test_the_estimate_does_not_use_the_true_state():
    """If the true robot is moved, the estimate does not change."""
    humanoid = TrialHumanoid(estimates_state=True)
    simulate(humanoid, 1.0)
    humanoid.data.qpos[:2] += 0.7, -0.4
    simulate(humanoid, 0.2)
    humanoid.walk_to(0.0, 0.0, 0.0)
    simulate(humanoid, 3.0)
    assert humanoid.mode is Mode.STANDING
    assert humanoid.base_pose().position[:2] == pytest.approx([0.7, -0.4], abs=0.05)


def test_reset_restarts_the_estimate():
    humanoid = TrialHumanoid(seed=5, estimates_state=True)

    def walk():
        humanoid.walk_velocity(0.2, 0.0, 0.1)
        simulate(humanoid, 2.0)
        return humanoid.data.qpos.tobytes()

    first = walk()
    humanoid.reset()
    assert walk() == first
