"""Joint angles that bring a hand to a pose, found without moving the robot."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import mujoco
import numpy as np

from robot_sim.arms.arm_chain import ArmChain
from robot_sim.arms.hand import hand_rotation
from robot_sim.model.side import SIDES, Side

LARGEST_BODY_SHIFT = 0.03  # m, largest motion of the body when it balances an arm


@dataclass(frozen=True)
class HandGoal:
    """A goal for the point between the pads of a hand, in base_link.

    Attributes:
        position: (3,) m.
        rotation: (3, 3) of the hand, x along the fingers, y in their opening direction; None: any.
        with_waist: the waist may turn, too.
        balancing: the goal is fixed in the world. While the arm moves, base_link moves, too, because the robot keeps
            its centre of mass above its feet. False: the goal is fixed to base_link.
    """

    position: np.ndarray
    rotation: np.ndarray | None = None
    with_waist: bool = False
    balancing: bool = False


@dataclass(frozen=True)
class ArmPosture:
    """Joints of an arm, with waist_yaw before them if it may turn, and their positions, rad."""

    names: tuple[str, ...]
    positions: tuple[float, ...]


class Unreachable(ValueError):
    """No posture brings the hand to the goal; the message says why."""


@dataclass(frozen=True, slots=True)
class SolverParameters:
    """Tolerances and effort of the solver."""

    position_tolerance: float = 1e-4  # m
    rotation_tolerance: float = 1e-3  # rad
    rotation_weight: float = 0.3  # m/rad
    least_damping: float = 1e-6  # m²
    longest_step: float = 0.6  # rad, of a joint
    most_steps: int = 40  # from one start
    standstill: float = 0.9  # a step that leaves more than this share of the squared error ends a descent
    starts: int = 30
    seed: int = 9  # of the random starts


class ArmInverseKinematics:
    """A solver for both arms.

    From each start it reduces the squared error step by step, by the Levenberg-Marquardt method with the squared error
    as the damping: far from a solution its steps do not overshoot, and near one they are not too small (T. Sugihara,
    "Solvability-unconcerned inverse kinematics by the Levenberg-Marquardt method", IEEE Transactions on Robotics 27(5),
    2011). Joints at the end of their range are left out of a step. The first start is the arm's present posture, so
    that a near solution is found first. The relaxed arm and random postures follow. The random postures are always the
    same, so the same goal in the same state has the same solution.
    """

    def __init__(self, model: mujoco.MjModel) -> None:
        self._parameters = SolverParameters()
        self._model = model
        self._data = mujoco.MjData(model)
        self._chains = {
            (side, turns): ArmChain(model, side, turns) for side in SIDES for turns in (False, True)
        }
        self._body = model.body("pelvis").id
        self._jacobian = np.zeros((6, model.nv))
        self._com_jacobian = np.zeros((3, model.nv))

    def solve(self, state: mujoco.MjData, side: Side, goal: HandGoal) -> ArmPosture:
        """Return a posture that brings the hand to the goal, while all other joints are as in `state`.

        Raises:
            Unreachable: no posture was found, or only postures in which the arm meets the robot's own body.
        """
        chain = self._chains[side, goal.with_waist]
        self._stand_at_the_origin(state)
        missing = chain.metres_short(self._data, goal.position)
        if missing > (LARGEST_BODY_SHIFT if goal.balancing else self._parameters.position_tolerance):
            raise Unreachable(f"the arm is {missing:.3f} m too short")
        closest = _Miss(np.inf, np.inf, np.inf)
        touches = False
        for start in self._starts(chain):
            positions, miss = self._descend(chain, goal, start)
            if not self._is_within_tolerance(miss):
                closest = min(closest, miss, key=lambda each: each.cost)
                continue
            mujoco.mj_collision(self._model, self._data)
            if not chain.touches_the_robot(self._data):
                return ArmPosture(chain.names, tuple(positions.tolist()))
            touches = True
        if touches:
            raise Unreachable("the arm would have to be inside the robot's own body")
        raise Unreachable(
            f"the closest posture found leaves the hand {closest.distance:.3f} m and {closest.angle:.2f} rad away"
        )

    def _stand_at_the_origin(self, state: mujoco.MjData) -> None:
        """Copy the joint positions of a state, with base_link at the origin of the world."""
        root = self._model.joint("root").qposadr[0]
        self._data.qpos[:] = state.qpos
        self._data.qpos[root : root + 7] = 0, 0, 0, 1, 0, 0, 0
        mujoco.mj_kinematics(self._model, self._data)
        mujoco.mj_comPos(self._model, self._data)
        self._com = self._data.subtree_com[self._body].copy()

    def _starts(self, chain: ArmChain) -> Iterator[np.ndarray]:
        yield np.clip(self._data.qpos[chain.positions], chain.low, chain.high)
        yield chain.relaxed
        chance = np.random.default_rng(self._parameters.seed)
        for _ in range(self._parameters.starts - 2):
            yield chance.uniform(chain.low, chain.high)

    def _descend(self, chain: ArmChain, goal: HandGoal, start: np.ndarray) -> tuple[np.ndarray, _Miss]:
        """Return the posture (n,) rad that is found from a start, and its distance from the goal."""
        positions = start
        error, miss = self._error(chain, goal, positions)
        for _ in range(self._parameters.most_steps):
            if self._is_within_tolerance(miss):
                break
            before = miss
            positions = self._step(chain, goal, positions, error)
            error, miss = self._error(chain, goal, positions)
            if miss.cost > self._parameters.standstill * before.cost:
                break
        return positions, miss

    def _error(self, chain: ArmChain, goal: HandGoal, positions: np.ndarray) -> tuple[np.ndarray, _Miss]:
        """Set the arm's positions; return the error, (3,) m or with the weighted rotation (6,) m, and the distances."""
        self._data.qpos[chain.positions] = positions
        mujoco.mj_kinematics(self._model, self._data)
        mujoco.mj_comPos(self._model, self._data)
        shift = goal.position - self._data.site_xpos[chain.grip]
        if goal.balancing:
            shift[:2] += (self._data.subtree_com[self._body] - self._com)[:2]
        if goal.rotation is None:
            return shift, _Miss(float(np.linalg.norm(shift)), 0.0, float(shift @ shift))
        turn = rotation_vector(hand_rotation(self._data.site_xmat[chain.grip]), goal.rotation)
        error = np.concatenate((shift, self._parameters.rotation_weight * turn))
        return error, _Miss(float(np.linalg.norm(shift)), float(np.linalg.norm(turn)), float(error @ error))

    def _step(self, chain: ArmChain, goal: HandGoal, positions: np.ndarray, error: np.ndarray) -> np.ndarray:
        """Return the positions (n,) rad after one step, within the joints' ranges."""
        mujoco.mj_jacSite(self._model, self._data, self._jacobian[:3], self._jacobian[3:], chain.grip)
        if goal.balancing:
            mujoco.mj_jacSubtreeCom(self._model, self._data, self._com_jacobian, self._body)
            self._jacobian[:2] -= self._com_jacobian[:2]
        jacobian = self._jacobian[: len(error), chain.dofs]
        jacobian[3:] *= self._parameters.rotation_weight
        damping = (error @ error / 2 + self._parameters.least_damping) * np.eye(len(error))
        free = np.ones(len(positions), dtype=bool)
        while True:
            step = np.linalg.solve(jacobian @ jacobian.T + damping, error) @ jacobian
            step *= min(1.0, self._parameters.longest_step / max(np.abs(step).max(), 1e-12))
            moved = positions + step
            stopped = free & (
                ((moved < chain.low) & (positions <= chain.low))
                | ((moved > chain.high) & (positions >= chain.high))
            )
            if not stopped.any():
                return np.clip(moved, chain.low, chain.high)
            free &= ~stopped
            jacobian[:, stopped] = 0.0

    def _is_within_tolerance(self, miss: _Miss) -> bool:
        limits = self._parameters
        return miss.distance < limits.position_tolerance and miss.angle < limits.rotation_tolerance


@dataclass(frozen=True, slots=True)
class _Miss:
    """How far a hand is from its goal."""

    distance: float  # m
    angle: float  # rad
    cost: float  # m², the squared error that the solver minimizes


def rotation_vector(start: np.ndarray, end: np.ndarray) -> np.ndarray:
    """Return the rotation (3,) rad, world frame, that turns rotation matrix `start` (3, 3) into `end` (3, 3)."""
    quaternion, vector = np.empty(4), np.empty(3)
    mujoco.mju_mat2Quat(quaternion, (end @ start.T).ravel())
    mujoco.mju_quat2Vel(vector, quaternion, 1.0)
    return vector
