"""The control of waist, head and arms: hold, follow a trajectory, or move a hand to a target."""

from __future__ import annotations

from dataclasses import dataclass, field

import mujoco
import numpy as np

from robot_sim.arms.joint_trajectory import MOVABLE, JointPath, JointTrajectory
from robot_sim.arms.reach import HandTarget, Reach, ReachParameters
from robot_sim.arms.servos import Servos
from robot_sim.model.side import Side


@dataclass(frozen=True, slots=True)
class UpperBodyParameters:
    """Limits of waist, head and arms."""

    waist_speed: float = 1.0  # rad/s; faster throws the robot off balance
    arm_speed: float = 3.0  # rad/s
    head_speed: float = 4.0  # rad/s
    reach: ReachParameters = field(default_factory=ReachParameters)

    def speed_limit(self, joint: str) -> float:
        """Return the highest speed of a joint, rad/s."""
        part = joint.partition("_")[0]
        return {"waist": self.waist_speed, "head": self.head_speed}.get(part, self.arm_speed)


class UpperBody:
    """The controller of the 18 joints of waist, head and arms. A joint without a command holds its position.

    Until the first command the servos hold the posture of the stance by themselves.
    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        self._parameters = UpperBodyParameters()
        self._model, self._data = model, data
        self._servos = Servos(model, data, MOVABLE)
        self._index = {name: index for index, name in enumerate(MOVABLE)}
        self._speed_limit = np.array([self._parameters.speed_limit(name) for name in MOVABLE])
        self._position = self._servos.position.copy()
        self._goal = self._position.copy()
        self._velocity = np.zeros(len(MOVABLE))
        self._commanded = False
        self._path: JointPath | None = None
        self._path_joints: list[int] = []
        self._path_time = 0.0
        self._reaches: dict[Side, Reach] = {}

    def follow(self, trajectory: JointTrajectory) -> None:
        """Follow a trajectory from the present positions; it replaces an earlier one. Empty: hold.

        Positions are clamped to the joints' ranges, and no joint moves faster than its limit.
        """
        self._begin()
        self._reaches.clear()
        self._path = None
        self._goal[:] = self._position
        if trajectory.waypoints and trajectory.joints:
            self._path_joints = [self._index[name] for name in trajectory.joints]
            self._path = JointPath(
                trajectory,
                self._position[self._path_joints].tolist(),
                self._velocity[self._path_joints].tolist(),
            )
            self._path_time = 0.0

    def reach(self, side: Side, target: HandTarget) -> Reach:
        """Move the hand of a side to a target in a straight line; this ends a trajectory."""
        self._begin()
        self._path = None
        self._goal[:] = self._position
        reach = Reach(self._model, self._data, side, target, self._parameters.reach)
        self._reaches[side] = reach
        return reach

    def tick(self, dt: float) -> None:
        """Command the servos for the next `dt` (s); call it between `mj_step1` and `mj_step2`."""
        if not self._commanded:
            return
        if self._path is not None:
            self._path_time += dt
            self._goal[self._path_joints] = self._path.at(self._path_time)
            if self._path_time >= self._path.duration:
                self._path = None
        for reach in self._reaches.values():
            joints = [self._index[name] for name in reach.joints]
            self._goal[joints] = self._position[joints] + reach.joint_velocities(self._position[joints]) * dt
        step = self._speed_limit * dt
        before = self._position.copy()
        within_range = self._servos.within_range(self._goal)
        self._position += np.minimum(np.maximum(within_range - before, -step), step)
        for reach in self._reaches.values():
            self._limit_windup(reach)
        self._velocity = (self._position - before) / dt
        self._servos.command(self._position, self._velocity)

    @property
    def is_idle(self) -> bool:
        """Whether no joint moves and no motion is left to do."""
        return self._path is None and not self._reaches and not self._velocity.any()

    def _begin(self) -> None:
        """Start to command the servos, from the positions that they have held by themselves."""
        if not self._commanded:
            self._commanded = True
            self._position[:] = self._servos.within_range(self._servos.position)
            self._goal[:] = self._position

    def _limit_windup(self, reach: Reach) -> None:
        """Limit the distance between reference and measured position, which would grow if the arm is blocked."""
        joints = [self._index[name] for name in reach.joints]
        measured, slack = self._servos.position[joints], self._parameters.reach.windup
        self._position[joints] = np.clip(self._position[joints], measured - slack, measured + slack)
