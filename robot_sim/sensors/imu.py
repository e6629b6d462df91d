"""The inertial measurement unit in the pelvis."""

from __future__ import annotations

from dataclasses import dataclass

import mujoco
import numpy as np

from robot_sim.state import ImuSample


@dataclass(frozen=True, slots=True)
class ImuParameters:
    """Imperfection of the inertial sensor (standard deviations)."""

    gyro_bias: float = 0.002  # rad/s, drawn once for each seed
    gyro_noise: float = 0.001  # rad/s
    accelerometer_bias: float = 0.05  # m/s², drawn once for each seed
    accelerometer_noise: float = 0.02  # m/s²


class Imu:
    """Gyro, accelerometer and orientation, with the errors of a real sensor: noise, and a constant bias.

    The errors depend only on seed and time, so reading more or less often does not change them. A calibration finds the
    biases while the robot stands: the mean of the gyro, and the mean of the accelerometer minus gravity.

    Attributes:
        gyro_bias: (3,) rad/s.
        accelerometer_bias: (3,) m/s².
    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, seed: int) -> None:
        self._data = data
        self._seed = seed
        self._parameters = ImuParameters()
        self._timestep = model.opt.timestep
        self._orientation = data.sensor("imu_orientation").data
        self._gyro = data.sensor("imu_gyro").data
        self._accelerometer = data.sensor("imu_accelerometer").data
        bias = np.random.default_rng(seed).normal(size=6)
        self.gyro_bias = self._parameters.gyro_bias * bias[:3]
        self.accelerometer_bias = self._parameters.accelerometer_bias * bias[3:]

    def read(self) -> ImuSample:
        """Return the present sample."""
        tick = round(self._data.time / self._timestep)
        noise = np.random.default_rng((self._seed, tick)).normal(size=6)
        return ImuSample(
            orientation=np.roll(self._orientation, -1),  # MuJoCo has w first
            angular_velocity=self._gyro + self.gyro_bias + self._parameters.gyro_noise * noise[:3],
            linear_acceleration=self._accelerometer
            + self.accelerometer_bias
            + self._parameters.accelerometer_noise * noise[3:],
        )
