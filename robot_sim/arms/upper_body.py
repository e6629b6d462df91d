"""The control of waist, head and arms: hold, or follow a trajectory."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import mujoco
import numpy as np

from robot_sim.arms.joint_trajectory import JointPath, JointTrajectory
from robot_sim.arms.servos import Servos


@dataclass(frozen=True, slots=True)
class UpperBodyParameters:
    """Limits of waist, head and arms."""

    waist_speed: float = 1.0  # rad/s; faster throws the robot off balance
    arm_speed: float = 3.0  # rad/s
    head_speed: float = 4.0  # rad/s

    def speed_limit(self, joint: str) -> float:
        """Return the highest speed of a joint, rad/s."""
        part = joint.partition("_")[0]
        return {"waist": self.waist_speed, "head": self.head_speed}.get(part, self.arm_speed)


class UpperBody:
    """The controller of `joints` of waist, head and arms. A joint without a command holds its position.

    Until the first command the servos hold the posture of the stance by themselves.
    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, joints: Sequence[str]) -> None:
        self._parameters = UpperBodyParameters()
        self._servos = Servos(model, data, joints)
        self._index = {name: index for index, name in enumerate(joints)}
        self._speed_limit = np.array([self._parameters.speed_limit(name) for name in joints])
        self._position = self._servos.position.copy()
        self._goal = self._position.copy()
        self._velocity = np.zeros(len(joints))
        self._commanded = False
        self._path: JointPath | None = None
        self._path_joints: list[int] = []
        self._path_time = 0.0

    def follow(self, trajectory: JointTrajectory) -> None:
        """Follow a trajectory from the present positions; it replaces an earlier one. Empty: hold.

        Positions are clamped to the joints' ranges, and no joint moves faster than its limit.
        """
        self._begin()
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

    def tick(self, dt: float) -> None:
        """Command the servos for the next `dt` (s); call it between `mj_step1` and `mj_step2`."""
        if not self._commanded:
            return
        if self._path is not None:
            self._path_time += dt
            self._goal[self._path_joints] = self._path.at(self._path_time)
            if self._path_time >= self._path.duration:
                self._path = None
        before = self._position.copy()
        self._move_to_goal(self._speed_limit * dt)
        self._velocity = (self._position - before) / dt
        self._servos.command(self._position, self._velocity)

    def _move_to_goal(self, step: np.ndarray) -> None:
        """Move each joint's commanded position by at most `step` (rad)."""
        within_range = self._servos.within_range(self._goal)
        self._position += np.minimum(np.maximum(within_range - self._position, -step), step)

    @property
    def is_idle(self) -> bool:
        """Whether no joint moves and no motion is left to do."""
        return self._path is None and not self._velocity.any()

    def _begin(self) -> None:
        """Start to command the servos, from the positions that they have held by themselves."""
        if not self._commanded:
            self._commanded = True
            self._position[:] = self._servos.within_range(self._servos.position)
            self._goal[:] = self._position
