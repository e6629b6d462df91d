"""Moves a hand to a target: resolved-rate control of an arm with damped least squares."""

from __future__ import annotations

import math
from dataclasses import dataclass

import mujoco
import numpy as np

from robot_sim.arms.arm_chain import relaxed_arm
from robot_sim.arms.inverse_kinematics import rotation_vector
from robot_sim.arms.joint_trajectory import MOVABLE, JointTrajectory
from robot_sim.arms.upper_body import UpperBody
from robot_sim.model.joint_names import WAIST, arm_joints
from robot_sim.model.side import Side

LEAST_DAMPING = 1e-3  # m, just enough to keep a matrix invertible


@dataclass(frozen=True, slots=True)
class ReachParameters:
    """Gains and limits of a reach."""

    gain: float = 6.0  # 1/s, of the measured error
    damping: float = 0.05  # m, of the least squares
    rotation_weight: float = 0.3  # m/rad
    relaxation: float = 0.8  # 1/s, towards the relaxed posture
    joint_speed: float = 2.5  # rad/s
    turn_speed: float = 2.0  # rad/s, of the hand
    windup: float = 0.25  # rad, largest distance of the reference from the measured joint


@dataclass(frozen=True)
class HandTarget:
    """A pose for the grip point of a hand, in the world frame.

    Attributes:
        position: (x, y, z), m.
        rotation: (3, 3) of the hand, whose fingers point along -z and open along y; None: any.
        speed: m/s, along the straight line there.
        with_waist: the waist may turn to help.
    """

    position: tuple[float, float, float]
    rotation: np.ndarray | None = None
    speed: float = 0.3
    with_waist: bool = False


class Reach:
    """A motion of one hand along a straight line to a target, at which it then stays.

    Joint velocities follow from the hand's velocity by damped least squares, q̇ = Jᵀ(JJᵀ + λ²I)⁻¹ v (C. W. Wampler,
    "Manipulator inverse kinematic solutions based on vector formulations and damped least-squares methods", IEEE
    SMC-16, 1986); the null space of the task takes the arm to a relaxed posture.

    Attributes:
        joints: names of the joints it moves.
    """

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        side: Side,
        target: HandTarget,
        parameters: ReachParameters,
    ) -> None:
        if not all(map(math.isfinite, target.position)):
            raise ValueError(f"the target is {target.position}; expected three finite numbers in m")
        waist = WAIST[:1] if target.with_waist else ()
        self.joints = [*waist, *arm_joints(side)]
        self._model, self._data, self._target, self._parameters = model, data, target, parameters
        self._grip = model.site(f"{side.letter}_grip").id
        self._dofs = np.array([model.joint(name).dofadr[0] for name in self.joints])
        self._relaxed = np.array([0.0] * len(waist) + relaxed_arm(side))
        self._reference = data.site_xpos[self._grip].copy()
        self._jacobian = np.zeros((6, model.nv))

    def error(self) -> float:
        """Distance of the grip point from the target, m."""
        return float(np.linalg.norm(np.array(self._target.position) - self._data.site_xpos[self._grip]))

    def rotation_error(self) -> float:
        """Angle between the hand and the target's rotation, rad; 0 if the target has none."""
        if self._target.rotation is None:
            return 0.0
        return float(np.linalg.norm(rotation_vector(self._rotation(), self._target.rotation)))

    def joint_velocities(self, reference: np.ndarray) -> np.ndarray:
        """Return the velocities (n,) rad/s for the next tick of the joints, which are at `reference` (n,) rad."""
        mujoco.mj_jacSite(self._model, self._data, self._jacobian[:3], self._jacobian[3:], self._grip)
        jacobian, velocity = self._task()
        relax = self._parameters.relaxation * (self._relaxed - reference)
        # The projection has little damping: with more, the relaxation would pull the hand away from its target.
        velocities = (
            _damped_inverse(jacobian, self._parameters.damping) @ velocity
            + relax
            - _damped_inverse(jacobian, LEAST_DAMPING) @ (jacobian @ relax)
        )
        fastest = np.abs(velocities).max() / self._parameters.joint_speed
        return velocities / fastest if fastest > 1 else velocities

    def _task(self) -> tuple[np.ndarray, np.ndarray]:
        """Return the Jacobian and the wanted velocity of the task: position, and rotation if one is given."""
        weight = self._parameters.rotation_weight
        linear = self._linear_velocity()
        if self._target.rotation is None:
            return self._jacobian[:3, self._dofs], linear
        jacobian = np.vstack((self._jacobian[:3, self._dofs], weight * self._jacobian[3:, self._dofs]))
        turn = self._parameters.gain * rotation_vector(self._rotation(), self._target.rotation)
        return jacobian, np.concatenate((linear, weight * _shortened(turn, self._parameters.turn_speed)))

    def _linear_velocity(self) -> np.ndarray:
        """Feed-forward along the line plus a correction of the measured error, m/s."""
        speed, step = self._target.speed, self._target.speed * self._model.opt.timestep
        left = np.array(self._target.position) - self._reference
        distance = float(np.linalg.norm(left))
        ahead = np.zeros(3)
        if distance > step:
            ahead = left / distance * speed
            self._reference += left / distance * step
        else:
            self._reference += left
        correction = self._parameters.gain * (self._reference - self._data.site_xpos[self._grip])
        return _shortened(ahead + correction, 2 * speed)

    def _rotation(self) -> np.ndarray:
        return self._data.site_xmat[self._grip].reshape(3, 3)


def _damped_inverse(jacobian: np.ndarray, damping: float) -> np.ndarray:
    """Jᵀ(JJᵀ + λ²I)⁻¹ (n, m) of a Jacobian (m, n)."""
    regular = jacobian @ jacobian.T + damping**2 * np.eye(len(jacobian))
    return np.linalg.solve(regular, jacobian).T


def _shortened(vector: np.ndarray, longest: float) -> np.ndarray:
    length = float(np.linalg.norm(vector))
    return vector * (longest / length) if length > longest else vector


class ReachingUpperBody(UpperBody):
    """The controller of waist, head and arms, which can also move a hand to a target."""

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        super().__init__(model, data, MOVABLE)
        self._model, self._data = model, data
        self._reaches: dict[Side, Reach] = {}

    def follow(self, trajectory: JointTrajectory) -> None:
        """Follow a trajectory from the present positions; it replaces earlier motions."""
        super().follow(trajectory)
        self._reaches.clear()

    def reach(self, side: Side, target: HandTarget) -> Reach:
        """Move the hand of a side to a target in a straight line; this ends a trajectory."""
        self._begin()
        self._path = None
        self._goal[:] = self._position
        self._reaches[side] = Reach(self._model, self._data, side, target, ReachParameters())
        return self._reaches[side]

    def tick(self, dt: float) -> None:
        """Command the servos for the next `dt` (s)."""
        for reach in self._reaches.values():
            joints = [self._index[name] for name in reach.joints]
            self._goal[joints] = self._position[joints] + reach.joint_velocities(self._position[joints]) * dt
        super().tick(dt)

    def _move_to_goal(self, step: np.ndarray) -> None:
        """Move by at most `step`; limit the distance from the measured position, which grows if an arm is blocked."""
        super()._move_to_goal(step)
        for reach in self._reaches.values():
            joints = [self._index[name] for name in reach.joints]
            measured, slack = self._servos.position[joints], ReachParameters().windup
            self._position[joints] = np.clip(self._position[joints], measured - slack, measured + slack)

    @property
    def is_idle(self) -> bool:
        """Whether no joint moves and no motion is left to do."""
        return super().is_idle and not self._reaches
