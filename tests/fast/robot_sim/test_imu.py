"""The inertial sensor has errors, and three seconds of standing are enough to find its biases."""

from __future__ import annotations

import numpy as np
import pytest

from bench.robot.trial import simulate
from robot_sim.humanoid import Humanoid
from robot_sim.model.gravity import GRAVITY

RATE = 50  # Hz, as on the topic imu


def samples(humanoid: Humanoid, seconds: float) -> tuple[np.ndarray, np.ndarray]:
    """Gyro (n, 3) rad/s and accelerometer without gravity (n, 3) m/s²."""
    gyro, accelerometer = [], []
    for _ in range(round(seconds * RATE)):
        simulate(humanoid, 1 / RATE)
        imu = humanoid.imu()
        gyro.append(imu.angular_velocity)
        accelerometer.append(imu.linear_acceleration - GRAVITY * upwards(imu.orientation))
    return np.array(gyro), np.array(accelerometer)


def upwards(quaternion: np.ndarray) -> np.ndarray:
    """The world's z axis in the sensor's frame: the last row of the rotation matrix of (x, y, z, w)."""
    x, y, z, w = quaternion
    return np.array([2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)])


@pytest.fixture
def standing() -> Humanoid:
    humanoid = Humanoid(seed=4)
    simulate(humanoid, 1.0)
    return humanoid


def test_readings_scatter_about_a_bias(standing):
    gyro, accelerometer = samples(standing, 3.0)
    assert gyro.std(axis=0) == pytest.approx(0.001, rel=0.25)
    assert accelerometer.std(axis=0) == pytest.approx(0.02, rel=0.25)
    assert np.linalg.norm(gyro.mean(axis=0)) > 0.001
    assert np.linalg.norm(accelerometer.mean(axis=0)) > 0.02


def test_calibration_removes_the_bias(standing):
    gyro, accelerometer = samples(standing, 3.0)
    found_gyro, found_accelerometer = gyro.mean(axis=0), accelerometer.mean(axis=0)
    later_gyro, later_accelerometer = samples(standing, 3.0)
    for later, found in ((later_gyro, found_gyro), (later_accelerometer, found_accelerometer)):
        raw, calibrated = later.mean(axis=0), (later - found).mean(axis=0)
        assert np.linalg.norm(calibrated) < 0.2 * np.linalg.norm(raw)


def test_a_calibrated_gyro_keeps_the_heading(standing):
    """Integrated over ten seconds, which include a walk and a turn on the spot."""
    bias = samples(standing, 3.0)[0].mean(axis=0)
    began = standing.base_pose().yaw
    standing.walk_velocity(0.2, 0.0, 0.3)
    walking = samples(standing, 6.0)[0]
    standing.stop()
    stopping = samples(standing, 4.0)[0]
    rates = np.concatenate([walking, stopping])[:, 2]
    turned = standing.base_pose().yaw - began
    calibrated, raw = (rates - bias[2]).sum() / RATE, rates.sum() / RATE
    assert turned > 1.0
    assert abs(calibrated - turned) < 0.03
    assert abs(calibrated - turned) < abs(raw - turned)
