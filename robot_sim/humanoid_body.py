"""The course's own humanoid as one kind of robot."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import mujoco

from robot_sim.arms.joint_trajectory import MOVABLE
from robot_sim.body import Body
from robot_sim.model.build import build_model
from robot_sim.model.dimensions import dimensions_of
from robot_sim.model.joint_names import ACTUATED_JOINTS
from robot_sim.model.posture import take_stance
from robot_sim.model.scenes import SCENES
from robot_sim.model.side import SIDES
from robot_sim.walking.balance_gains import trunk_of
from robot_sim.walking.body_height import HeightLimits
from robot_sim.walking.walker import Walker
from robot_sim.walking.walker_parameters import WalkerParameters
from robot_sim.walking.walking_limits import WalkingLimits


class HumanoidBody(Body):
    """The robot of humanoid.xml, walked by a controller that plans footsteps."""

    name = "humanoid"
    scenes = tuple(SCENES)
    joints = tuple(ACTUATED_JOINTS)
    movable = MOVABLE
    hands = SIDES
    limits = WalkingLimits()
    heights = HeightLimits()
    fallen_height = 0.38
    may_rest = True

    def model(self, scene: str, shape: Callable[[mujoco.MjSpec], object]) -> mujoco.MjModel:
        """Compile the robot in a scene; `shape` is called with the model before."""
        return build_model(scene, shape=shape)

    def stance_height(self, model: mujoco.MjModel) -> float:
        """Return the height (m) of the pelvis above the floor while it stands."""
        return dimensions_of(model).stance_height

    def take_stance(
        self, model: mujoco.MjModel, data: mujoco.MjData, x: float, y: float, yaw: float, height: float
    ) -> None:
        """Reset the state to standing, or crouching, with the pelvis at (x, y, height) m, heading `yaw` rad."""
        take_stance(model, data, replace(dimensions_of(model), stance_height=height), x, y, yaw)

    def walker(
        self, model: mujoco.MjModel, data: mujoco.MjData, state: mujoco.MjData | None = None
    ) -> Walker:
        """Make the controller; it reads the state in `data`, or in `state` if the state is estimated."""
        return Walker(model, data, state or data, trunk_of(model), WalkerParameters(dimensions_of(model)))
