"""The inertial measurement unit in the pelvis."""

import mujoco
import numpy as np

from robot_sim.parameters import ImuParameters
from robot_sim.state import ImuSample


class Imu:
    """Gyro, accelerometer and orientation, with the small errors a real sensor has.

    The errors are a function of seed and time only: reading more or less often changes nothing.
    """

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        seed: int,
        parameters: ImuParameters | None = None,
    ) -> None:
        self._data = data
        self._seed = seed
        self._parameters = parameters or ImuParameters()
        self._timestep = model.opt.timestep
        self._orientation = data.sensor("imu_orientation").data
        self._gyro = data.sensor("imu_gyro").data
        self._accelerometer = data.sensor("imu_accelerometer").data
        self.gyro_bias = np.random.default_rng(seed).normal(0.0, self._parameters.gyro_bias, 3)  # rad/s

    def read(self) -> ImuSample:
        """The present sample."""
        tick = round(self._data.time / self._timestep)
        noise = np.random.default_rng((self._seed, tick)).normal(size=6)
        return ImuSample(
            orientation=np.roll(self._orientation, -1),  # MuJoCo has w first
            angular_velocity=self._gyro + self.gyro_bias + self._parameters.gyro_noise * noise[:3],
            linear_acceleration=self._accelerometer + self._parameters.accelerometer_noise * noise[3:],
        )
