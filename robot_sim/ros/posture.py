"""The whole posture of a robot as an event, from which a film can be made later."""

from __future__ import annotations

from collections.abc import Iterable

import mujoco
import numpy as np

from robot_sim.humanoid import Humanoid
from robot_sim.model.scenes import OBJECTS
from ros_runtime.record.ground_truth import BodyDescribed, PostureTruth

DIGITS = 5  # decimals: 0.01 mm


class PostureReader:
    """Reads the posture of a humanoid and the poses of the objects in its scene."""

    def __init__(self, humanoid: Humanoid) -> None:
        model = humanoid.model
        hinges = [
            model.joint(index)
            for index in range(model.njnt)
            if model.jnt_type[index] != mujoco.mjtJoint.mjJNT_FREE
        ]
        self._humanoid = humanoid
        self._places = np.array([joint.qposadr[0] for joint in hinges])
        self._rates = np.array([joint.dofadr[0] for joint in hinges])
        self._objects = list(OBJECTS[humanoid.scene])
        self.description = BodyDescribed(
            scene=humanoid.scene,
            joints=[joint.name for joint in hinges],
            objects=self._objects,
            robot=humanoid.body.name,
        )

    def read(self) -> PostureTruth:
        """Return the present posture."""
        data = self._humanoid.data
        pose, velocity = self._humanoid.base_pose(), self._humanoid.base_velocity()
        return PostureTruth(
            base=_rounded([*pose.position, *pose.quaternion]),
            twist=_rounded([*velocity.linear, *velocity.angular]),
            positions=_rounded(data.qpos[self._places]),
            velocities=_rounded(data.qvel[self._rates]),
            objects=[
                _rounded([*pose.position, *pose.quaternion])
                for pose in self._humanoid.object_poses().values()
            ],
        )


def _rounded(numbers: Iterable[float]) -> list[float]:
    return [round(float(number), DIGITS) for number in numbers]
