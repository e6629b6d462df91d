"""The estimated pose and velocity of the floating base, from inertial sensor, joint encoders and foot contacts."""

from __future__ import annotations

from dataclasses import dataclass

import mujoco
import numpy as np

from robot_sim.model.gravity import GRAVITY
from robot_sim.model.side import SIDES
from robot_sim.sensors.imu import Imu

UP = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True, slots=True)
class EstimateParameters:
    """Thresholds of the estimate, and the weight of each sensor in it."""

    contact_force: float = 30.0  # N; a foot with a higher load is assumed to stand still
    tilt_gain: float = 0.3  # 1/s, of the accelerometer's correction
    odometry_gain: float = 0.2  # of the velocity's error, each timestep
    anchor_gain: float = 0.1  # of the position's error, each timestep
    still: float = 0.03  # rad/s; below this rate the robot stands still, and the gyro measures only its bias
    bias_time: float = 0.5  # s, time constant for learning the bias


class StateEstimate:
    """An MjData with an estimated base and measured joints, for the controller to read instead of the true one.

    Attitude: the gyro minus its bias is integrated, and the accelerometer slowly corrects the tilt (R. Mahony,
    T. Hamel, J.-M. Pflimlin, "Nonlinear complementary filters on the special orthogonal group", IEEE TAC 53, 2008).
    Nothing corrects the heading, so it drifts. Velocity: the accelerometer is integrated and corrected by leg odometry,
    which assumes that a loaded foot does not move. Position: the velocity is integrated and corrected so that loaded
    feet stay where they landed, on a level floor.

    Args:
        model, data: the simulation; only its encoders, touch sensors and IMU are read.
        imu: its inertial sensor.

    Attributes:
        data: the estimated state.
    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, imu: Imu) -> None:
        self.data = mujoco.MjData(model)
        self._model, self._measured, self._imu = model, data, imu
        self._parameters = EstimateParameters()
        self._pelvis = model.body("pelvis").id
        self._soles = [model.site(f"{side.letter}_sole").id for side in SIDES]
        self._touches = [model.sensor(f"{side.letter}_foot_touch").adr[0] for side in SIDES]
        self._anchors: list[np.ndarray | None] = [None, None]
        self._gyro_bias = np.zeros(3)
        self._jacobian = np.zeros((3, model.nv))
        self.data.qpos[:], self.data.qvel[:] = data.qpos, data.qvel  # the first pose is given
        self._compute()

    def tick(self, dt: float) -> None:
        """Read the sensors and predict the state `dt` (s) later."""
        sample = self._imu.read()
        loads = self._loads()
        self._learn_gyro_bias(sample.angular_velocity, all(loads), dt)
        rate = sample.angular_velocity - self._gyro_bias
        velocity = self._predict(sample.linear_acceleration, rate, dt)
        self._correct(velocity, loads)
        self._compute()

    def _loads(self) -> list[float]:
        """Return the contact forces (N) of the feet; 0 for a foot with too little load to be assumed still."""
        loads = [float(self._measured.sensordata[touch]) for touch in self._touches]
        return [load if load > self._parameters.contact_force else 0.0 for load in loads]

    def _predict(self, force: np.ndarray, rate: np.ndarray, dt: float) -> np.ndarray:
        """Integrate accelerometer (m/s²) and gyro (rad/s), both in base_link.

        Returns:
            The velocity of the base, m/s, world frame.
        """
        estimated, measured = self.data, self._measured
        rotation = estimated.xmat[self._pelvis].reshape(3, 3)
        tilt = np.cross(force / np.linalg.norm(force), rotation.T @ UP)
        velocity = estimated.qvel[:3] + (rotation @ force - GRAVITY * UP) * dt
        mujoco.mju_quatIntegrate(estimated.qpos[3:7], rate + self._parameters.tilt_gain * tilt, dt)
        estimated.qpos[:3] += velocity * dt
        estimated.qpos[7:], estimated.qvel[6:] = measured.qpos[7:], measured.qvel[6:]
        estimated.qvel[:3], estimated.qvel[3:6] = 0.0, rate
        mujoco.mj_kinematics(self._model, estimated)
        mujoco.mj_comPos(self._model, estimated)
        return velocity

    def _correct(self, velocity: np.ndarray, loads: list[float]) -> None:
        """Correct velocity (m/s) and position of the base by the loaded feet, weighted by their load."""
        estimated, gains = self.data, self._parameters
        moved = np.zeros(3)
        for side, sole in zip(SIDES, self._soles, strict=True):
            if not loads[side]:
                self._anchors[side] = None
                continue
            share, place = loads[side] / sum(loads), estimated.site_xpos[sole]
            if self._anchors[side] is None:
                self._anchors[side] = np.array([place[0], place[1], 0.0])
            mujoco.mj_jacSite(self._model, estimated, self._jacobian, None, sole)
            # The estimated base still has velocity 0 here, so this is the foot's velocity relative to the base.
            velocity += gains.odometry_gain * share * (-self._jacobian @ estimated.qvel - velocity)
            moved += gains.anchor_gain * share * (self._anchors[side] - place)
        estimated.qpos[:3] += moved
        estimated.qvel[:3] = velocity

    def _learn_gyro_bias(self, rate: np.ndarray, stands: bool, dt: float) -> None:
        """Learn the bias while the robot stands still, when the true rate is 0."""
        gains = self._parameters
        if stands and np.abs(rate).max() < gains.still:
            self._gyro_bias += dt / gains.bias_time * (rate - self._gyro_bias)

    def _compute(self) -> None:
        """Compute what the controller reads; repeat the kinematics (3 µs), because the correction moved the base."""
        model, estimated = self._model, self.data
        mujoco.mj_kinematics(model, estimated)
        mujoco.mj_comPos(model, estimated)
        mujoco.mj_makeM(model, estimated)
        mujoco.mj_comVel(model, estimated)
        mujoco.mj_subtreeVel(model, estimated)
        mujoco.mj_rne(model, estimated, 0, estimated.qfrc_bias)
