"""A robot that was used and reset, or built before a fork, behaves bit for bit like a new one of its seed."""

from __future__ import annotations

import hashlib
import os

import numpy as np
import pytest

from bench.robot.trial import simulate
from g1 import needs_g1
from robot_sim.humanoid import Humanoid
from robot_sim.model.side import Side
from robot_sim.ros.options import RobotOptions
from robot_sim.ros.serve import build_humanoid

in_each_scene = pytest.mark.parametrize(
    ("robot", "scene"),
    [("humanoid", "flat"), ("humanoid", "stand"), pytest.param("g1", "flat", marks=needs_g1)],
)


def trace(humanoid: Humanoid) -> str:
    """A digest of all states during three seconds of standing, walking and moving an arm."""
    seen = hashlib.sha256()
    for tick in range(600):
        if tick == 200:
            humanoid.walk_velocity(0.3, 0.05, 0.2)
        elif tick == 450:
            humanoid.stop()
            if humanoid.hands:
                humanoid.open_hand(Side.LEFT, 0.05)
        humanoid.step()
        battery, imu = humanoid.battery, humanoid.imu()
        seen.update(humanoid.data.qpos.tobytes() + humanoid.data.qvel.tobytes())
        seen.update(humanoid.data.actuator_force.tobytes() + humanoid.data.sensordata.tobytes())
        seen.update(imu.angular_velocity.tobytes() + imu.linear_acceleration.tobytes())
        seen.update(repr((humanoid.time, battery.percentage, battery.voltage, battery.current)).encode())
        seen.update(repr((humanoid.mode, humanoid.steps, humanoid.base_pose().yaw)).encode())
    return seen.hexdigest()


def use(humanoid: Humanoid) -> None:
    """Change all parts of the robot's state."""
    humanoid.walk_velocity(0.2, 0.0, 0.4)
    humanoid.push((20.0, 10.0, 0.0), duration=0.5)
    humanoid.move_body(-0.1)
    for _ in range(150):
        humanoid.step()
    humanoid.battery.set_percentage(0.3)
    humanoid.set_motor_power(False)
    humanoid.step()


@in_each_scene
def test_a_used_robot_that_is_reset_is_a_fresh_one(robot, scene):
    used = Humanoid(scene, seed=1, robot=robot)
    use(used)
    used.seed = 4
    used.reset()
    assert trace(used) == trace(Humanoid(scene, seed=4, robot=robot))


def test_a_used_robot_can_be_reset_into_a_crouch():
    used = Humanoid()
    use(used)
    used.reset(height=0.45)
    assert trace(used) == trace(build_humanoid(RobotOptions(crouch=True)))


@in_each_scene
def test_a_robot_built_before_a_fork_is_a_fresh_one(robot, scene):
    built = build_humanoid(RobotOptions(robot=robot, scene=scene, seed=3))
    fresh = trace(Humanoid(scene, seed=3, robot=robot))
    assert traced_in_a_fork(built) == traced_in_a_fork(built) == fresh


def traced_in_a_fork(built: Humanoid) -> str:
    read, write = os.pipe()
    child = os.fork()
    if child == 0:
        try:
            os.write(write, trace(built).encode())
        finally:
            os._exit(0)
    os.close(write)
    with os.fdopen(read) as answer:
        digest = answer.read()
    os.waitpid(child, 0)
    return digest


def test_reading_sensors_changes_nothing():
    read, unread = Humanoid(), Humanoid()
    for humanoid in (read, unread):
        humanoid.walk_velocity(0.3, 0.05, 0.2)
    for _ in range(300):
        read.step()
        read.imu()
        unread.step()
    assert read.data.qpos.tobytes() == unread.data.qpos.tobytes()
    assert read.imu().angular_velocity.tobytes() == unread.imu().angular_velocity.tobytes()


def test_another_seed_has_another_gyro_bias_but_the_same_motion():
    one, other = Humanoid(seed=1), Humanoid(seed=2)
    simulate(one, 0.2)
    simulate(other, 0.2)
    assert one.data.qpos.tobytes() == other.data.qpos.tobytes()
    assert not np.allclose(one.imu().angular_velocity, other.imu().angular_velocity, atol=1e-6)
