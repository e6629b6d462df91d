"""What distinguishes one kind of robot from another, and the kinds that the simulation can run."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence

import mujoco

from robot_sim.model.side import Side
from robot_sim.walking.body_height import HeightLimits
from robot_sim.walking.walking_controller import WalkingController
from robot_sim.walking.walking_limits import WalkingLimits
from ros_runtime.course_error import CourseError

ROBOTS = ("humanoid", "g1")


class MissingParts(CourseError):
    """Packages of an optional robot are not installed; the message is one line with the command that installs them."""


class Body(ABC):
    """A kind of robot. Its pelvis is base_link; its torso, feet, soles and sensors have the names of humanoid.xml.

    Attributes:
        name: one of `ROBOTS`.
        scenes: those it can stand in.
        joints: names of the actuated joints, in the order of the actuators.
        movable: the joints that a trajectory can move.
        hands: the sides with a gripper.
        limits: how fast it walks.
        heights: how low it crouches.
        fallen_height: it has fallen if its pelvis is lower (m).
        may_rest: it can stand so still that its physics need not be integrated.
    """

    name: str
    scenes: Sequence[str]
    joints: Sequence[str]
    movable: Sequence[str]
    hands: Sequence[Side]
    limits: WalkingLimits
    heights: HeightLimits
    fallen_height: float
    may_rest: bool

    @abstractmethod
    def model(self, scene: str, shape: Callable[[mujoco.MjSpec], object]) -> mujoco.MjModel:
        """Compile the robot in a scene; `shape` is called with the model before."""

    @abstractmethod
    def stance_height(self, model: mujoco.MjModel) -> float:
        """Return the height (m) of the pelvis above the floor while it stands."""

    @abstractmethod
    def take_stance(
        self, model: mujoco.MjModel, data: mujoco.MjData, x: float, y: float, yaw: float, height: float
    ) -> None:
        """Reset the state to standing with the pelvis at (x, y, height) m, heading `yaw` rad."""

    @abstractmethod
    def walker(self, model: mujoco.MjModel, data: mujoco.MjData) -> WalkingController:
        """Make the controller that starts from the present state."""


def body_named(name: str) -> Body:
    """Return the kind of robot with one of the names in `ROBOTS`.

    Raises:
        ValueError: the name is not known.
        MissingParts: it is optional, and its packages are not installed.
    """
    if name not in ROBOTS:
        raise ValueError(f"robot {name!r} is not known; choose one of {', '.join(map(repr, ROBOTS))}")
    if name == "g1":
        from robot_sim.g1.body import G1Body

        return G1Body()
    from robot_sim.humanoid_body import HumanoidBody

    return HumanoidBody()
