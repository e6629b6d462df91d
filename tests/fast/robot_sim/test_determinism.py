"""The same seed and the same commands give the same robot, bit by bit."""

from __future__ import annotations

import numpy as np

from bench.robot.trial import simulate
from robot_sim.humanoid import Humanoid


def eventful_run(humanoid: Humanoid, read_sensors: bool = False) -> tuple:
    """Walk, get a push, stop; then return the robot's whole state."""
    humanoid.walk_velocity(0.3, 0.05, 0.2)
    for _ in range(30):
        simulate(humanoid, 0.05)
        if read_sensors:
            humanoid.imu()
    humanoid.push((4.0, 3.0, 0.0))
    humanoid.walk_to(0.5, 0.2, 0.3)
    simulate(humanoid, 1.5)
    humanoid.stop()
    simulate(humanoid, 1.0)
    imu = humanoid.imu()
    return (
        humanoid.time,
        humanoid.mode,
        humanoid.steps,
        humanoid.battery.percentage,
        humanoid.battery.current,
        humanoid.data.qpos.tobytes(),
        humanoid.data.qvel.tobytes(),
        imu.angular_velocity.tobytes(),
        imu.linear_acceleration.tobytes(),
    )


def test_two_robots_of_one_seed_are_identical():
    assert eventful_run(Humanoid(seed=3)) == eventful_run(Humanoid(seed=3))


def test_reading_sensors_changes_nothing():
    assert eventful_run(Humanoid(), read_sensors=True) == eventful_run(Humanoid())


def test_reset_restores_everything():
    humanoid = Humanoid(seed=5)
    first = eventful_run(humanoid)
    humanoid.battery.set_percentage(0.4)
    humanoid.push((90.0, 0.0, 0.0), duration=0.3)
    simulate(humanoid, 1.0)
    humanoid.set_motor_power(False)
    humanoid.reset()
    assert (humanoid.time, humanoid.steps, humanoid.battery.percentage) == (0.0, 0, 1.0)
    assert humanoid.motors_enabled
    assert eventful_run(humanoid) == first


def test_another_seed_has_another_gyro_bias_but_the_same_motion():
    one, other = Humanoid(seed=1), Humanoid(seed=2)
    simulate(one, 0.2)
    simulate(other, 0.2)
    assert one.data.qpos.tobytes() == other.data.qpos.tobytes()
    assert not np.allclose(one.imu().angular_velocity, other.imu().angular_velocity, atol=1e-6)
