"""Whole-body control: computes leg torques that accelerate the body and the swing foot as the gait requires.

It is inverse dynamics of the floating base, without an optimizer. The accelerations required of pelvis and feet
determine those of the legs. M q̈ + h then gives the generalized forces. The floor must supply the forces of the base;
the feet's Jacobians map them to the legs, and the rest are the torques of the leg motors. The motion of legs and arms
moves the centre of mass, too. So the base acceleration is corrected until the linear momentum of the whole body changes
as the inverted pendulum requires (linear momentum rate = contact force + weight; D. E. Orin, A. Goswami, S.-H. Lee,
"Centroidal dynamics of a humanoid robot", Autonomous Robots 35, 2013).
"""

from __future__ import annotations

import math

import mujoco
import numpy as np

from robot_sim.model.gravity import GRAVITY
from robot_sim.model.joint_names import LEG_JOINTS
from robot_sim.model.side import SIDES
from robot_sim.walking.attitude import to_body, upright_error
from robot_sim.walking.balance_gains import Trunk, default_gains
from robot_sim.walking.balance_task import BalanceTask
from robot_sim.walking.contact_wrench import LoadSplit, contact_wrench
from robot_sim.walking.dcm_plan import Point
from robot_sim.walking.foot_tipping import cop_against_tipping
from robot_sim.walking.planar import clamp
from robot_sim.walking.sensing import Sensing
from robot_sim.walking.support import left_share_of
from robot_sim.walking.swing import SwingReference
from robot_sim.walking.walker_parameters import WalkerParameters
from ros_runtime.angles import wrap

UPWARD_GRAVITY = np.array([0.0, 0.0, GRAVITY])
REGULARIZATION = 1e-4 * np.eye(6)  # keeps a leg's Jacobian invertible when the knee is straight


class WholeBody:
    """The controller that turns balance tasks into the torques of the twelve leg motors.

    Attributes:
        cop_shift: low-pass filtered offset (m) between the CoP that was produced and the CoP of the task.
        height: commanded height of the pelvis above the floor, m.
        gains: how stiffly the trunk is held upright.
    """

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        ctrl: np.ndarray,
        trunk: Trunk,
        parameters: WalkerParameters,
    ) -> None:
        self.cop_shift: Point = (0.0, 0.0)
        self._model, self._data = model, data
        self._balance = parameters.balance
        self._tipping = parameters.tipping
        self.height = parameters.dimensions.stance_height
        self._trunk = trunk
        self.gains = default_gains(trunk, parameters.balance)
        self._split = LoadSplit(parameters.dimensions, parameters.balance)
        self._mass = float(model.body_subtreemass[model.body("pelvis").id])
        self._yaw: float | None = None

        self._soles = [model.site(f"{side.letter}_sole").id for side in SIDES]
        root = model.joint("root").dofadr[0]
        base = slice(root, root + 6)
        linear = slice(root, root + 3)
        legs = _consecutive([model.joint(name).dofadr[0] for name in LEG_JOINTS])
        motors = _consecutive([model.actuator(name).id for name in LEG_JOINTS])
        self._least_torque, self._most_torque = model.actuator_ctrlrange[motors].T.reshape(2, 2, 6)
        self._friction = model.dof_damping[legs].reshape(2, 6)

        # Views of the arrays that each tick fills; arrays of the legs have a row for each side.
        self._ctrl = ctrl[motors].reshape(2, 6)
        self._velocity, self._leg_velocity = data.qvel, data.qvel[legs].reshape(2, 6)
        self._bias = data.qfrc_bias
        self._jacobian = np.zeros((2, 6, model.nv))
        self._halves = [(sole[:3], sole[3:]) for sole in self._jacobian]
        self._rows = self._jacobian.reshape(12, model.nv)
        self._base_jacobian = self._rows[:, base]
        # For each sole, only the columns of its own leg: (2, 6, 6).
        self._leg_jacobian = np.einsum("sisj->sij", self._jacobian[:, :, legs].reshape(2, 6, 2, 6))
        self._acceleration = np.zeros(model.nv)
        self._base_acceleration, self._base_linear = self._acceleration[base], self._acceleration[linear]
        self._leg_acceleration = self._acceleration[legs].reshape(2, 6)
        self._forces = np.zeros(model.nv)
        self._base_forces, self._base_force = self._forces[base], self._forces[linear]
        self._leg_forces = self._forces[legs].reshape(2, 6)

    def command(self, task: BalanceTask, sensed: Sensing, dt: float) -> None:
        """Write the leg torques (N·m) of the next `dt` (s) into the motors."""
        self._compute_forces(task, sensed, dt)
        wrench = contact_wrench(self._base_forces.tolist(), sensed, self._mass, self._balance)
        self._filter_cop_shift(wrench.cop, task.cop, dt)
        left_share = task.left_share
        if left_share is None:
            left_share = left_share_of(wrench.cop, sensed)
        foot_wrenches = []
        for side in SIDES:
            shift = cop_against_tipping(
                sensed.sole_rotations[side], sensed.slope, self._sole_spin[side], self._tipping
            )
            foot_wrenches.append(self._split.foot_wrench(side, wrench, left_share, sensed, shift))
        torque = self._leg_forces + self._friction * self._leg_velocity
        torque -= (np.array(foot_wrenches)[:, np.newaxis] @ self._leg_jacobian)[:, 0]
        self._ctrl[:] = np.minimum(np.maximum(torque, self._least_torque), self._most_torque)

    def _compute_forces(self, task: BalanceTask, sensed: Sensing, dt: float) -> None:
        """Compute the generalized forces of the task's motion, without contact forces."""
        for halves, sole in zip(self._halves, self._soles, strict=True):
            mujoco.mj_jacSite(self._model, self._data, *halves, sole)
        self._base_acceleration[:] = self._wanted_base_acceleration(task, sensed, dt)
        wanted = self._mass * (self._base_linear + UPWARD_GRAVITY)

        foot_acceleration = self._foot_acceleration(task, sensed)
        foot_acceleration -= (self._base_jacobian @ self._base_acceleration).reshape(2, 6)
        to_joints = np.linalg.inv(self._leg_jacobian + REGULARIZATION)
        self._leg_acceleration[:] = (to_joints @ foot_acceleration[:, :, np.newaxis])[:, :, 0]
        self._compute_forces_of_acceleration()

        linear_to_joints = to_joints[:, :, :3]
        for _ in range(self._balance.momentum_iterations):
            correction = (wanted - self._base_force) / self._mass
            self._base_linear += correction
            self._leg_acceleration -= linear_to_joints @ correction
            self._compute_forces_of_acceleration()

    def _compute_forces_of_acceleration(self) -> None:
        """Compute M q̈ + h for the present accelerations; `mj_mulM` skips the elements of M that are 0."""
        mujoco.mj_mulM(self._model, self._data, self._forces, self._acceleration)
        self._forces += self._bias

    def _wanted_base_acceleration(self, task: BalanceTask, sensed: Sensing, dt: float) -> list[float]:
        """Return the linear (m/s², world) and angular (rad/s², base_link) acceleration required of the base.

        Horizontally it is that of the linear inverted pendulum, c̈ = ω² (c - p). PD controllers hold height and
        attitude. The trunk is an inverted pendulum, too, so the gains have to overcome its torque of gravity.
        """
        gains, trunk = self._balance, self._trunk
        stiffness = sensed.omega**2
        height_error = self.height + sensed.ground - sensed.pelvis[2]
        yaw = self._slew_yaw(task.yaw, dt)
        attitude = to_body(
            sensed.pelvis_rotation,
            upright_error(sensed.pelvis_rotation, math.cos(yaw), math.sin(yaw)),
        )
        _, _, climb, *spin = sensed.base_velocity
        return [
            stiffness * (sensed.com[0] - task.cop[0]),
            stiffness * (sensed.com[1] - task.cop[1]),
            gains.height_stiffness * height_error - gains.height_damping * climb,
            (self.gains.roll_torque(attitude[0], spin[0]) - trunk.topple * attitude[0]) / trunk.roll_inertia,
            (self.gains.pitch_torque(attitude[1], spin[1]) - trunk.topple * attitude[1])
            / trunk.pitch_inertia,
            gains.yaw_stiffness * attitude[2] - gains.yaw_damping * spin[2],
        ]

    def _slew_yaw(self, yaw: float, dt: float) -> float:
        """Move the heading reference to `yaw` (rad) at a limited rate because it jumps at touchdown."""
        if self._yaw is None:
            self._yaw = yaw
        most = self._balance.yaw_rate * dt
        self._yaw += clamp(wrap(yaw - self._yaw), -most, most)
        return self._yaw

    def _foot_acceleration(self, task: BalanceTask, sensed: Sensing) -> np.ndarray:
        """Return the accelerations (2, 6) required of the soles, world frame: to stop, or to follow the swing."""
        velocity = (self._rows @ self._velocity).reshape(2, 6)
        self._sole_spin = velocity[:, 3:].tolist()
        acceleration = -self._balance.stance_damping * velocity
        if task.swing is not None:
            side = task.swing.side
            acceleration[side] = self._swing_acceleration(
                task.swing, sensed.soles[side], sensed.sole_rotations[side], velocity[side].tolist()
            )
        return acceleration

    def _swing_acceleration(
        self,
        swing: SwingReference,
        position: list[float],
        rotation: list[float],
        velocity: list[float],
    ) -> list[float]:
        """Return the acceleration of the swing sole: feed-forward, plus PD on its path and its tilt to the floor."""
        gains = self._balance
        linear = [
            feed_forward + gains.swing_stiffness * (goal - at) + gains.swing_damping * (goal_speed - speed)
            for feed_forward, goal, at, goal_speed, speed in zip(
                swing.acceleration, swing.position, position, swing.velocity, velocity[:3], strict=True
            )
        ]
        roll, pitch, turn = upright_error(rotation, math.cos(swing.yaw), math.sin(swing.yaw))
        tilt = (roll + swing.slope[1], pitch - swing.slope[0], turn)
        angular = [
            gains.swing_turn_stiffness * error - gains.swing_turn_damping * rate
            for error, rate in zip(tilt, velocity[3:], strict=True)
        ]
        angular[2] += swing.yaw_acceleration + gains.swing_turn_damping * swing.yaw_rate
        return linear + angular

    def _filter_cop_shift(self, produced: Point, wanted: Point, dt: float) -> None:
        gains = self._balance
        fresh = 1 - gains.cop_shift_filter ** (dt / gains.cop_shift_period)
        x, y = self.cop_shift
        self.cop_shift = (
            x + fresh * (produced[0] - wanted[0] - x),
            y + fresh * (produced[1] - wanted[1] - y),
        )


def _consecutive(indices: list[int]) -> slice:
    """Return consecutive indices as a slice, because indexing with a slice gives a view, and with a list a copy."""
    return slice(indices[0], indices[-1] + 1)
