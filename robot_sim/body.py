"""What distinguishes one kind of robot from another, and the kinds that the simulation can run."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from mujoco import MjData, MjModel

from robot_sim.model.side import Side
from robot_sim.walking.body_height import HeightLimits
from robot_sim.walking.walking_limits import WalkingLimits
from ros_runtime.course_error import CourseError

if TYPE_CHECKING:
    from robot_sim.g1.walker import LearnedWalker
    from robot_sim.walking.walker import Walker

ROBOTS = ("humanoid", "g1")


class MissingParts(CourseError):
    """Packages of an optional robot are not installed; the message is one line with the command that installs them."""


@dataclass(frozen=True)
class Body:
    """A kind of robot. Its pelvis is base_link; its torso, feet, soles and sensors have the names of humanoid.xml.

    Attributes:
        name: one of `ROBOTS`.
        limits: how fast it walks.
        heights: how low it crouches.
        fallen_height: it has fallen if its pelvis is lower (m).
        still_speed: slower than this (m/s) its pelvis moves from a second after a stop.
        model: compiles the robot, standing in a scene; a function is called with the model before.
        take_stance: resets the state to standing with the pelvis at (x, y) m, heading `yaw` rad, and a height (m).
        walker: makes the controller that starts from the present state, with the interface of `Walker`.
        movable: the joints that a trajectory can move.
        hands: the sides with a gripper.
        may_rest: it can stand so still that its physics need not be integrated.
    """

    name: str
    limits: WalkingLimits
    heights: HeightLimits
    fallen_height: float
    still_speed: float
    model: Callable[[str, Callable[[Any], object]], MjModel]
    take_stance: Callable[[MjModel, MjData, float, float, float, float], None]
    walker: Callable[[MjModel, MjData], Walker | LearnedWalker]
    movable: Sequence[str] = ()
    hands: Sequence[Side] = ()
    may_rest: bool = False


def body_named(name: str) -> Body:
    """Return the kind of robot with one of the names in `ROBOTS`.

    Raises:
        ValueError: the name is not known.
        MissingParts: it is optional, and its packages are not installed.
    """
    if name == "humanoid":
        from robot_sim.humanoid_body import HUMANOID

        return HUMANOID
    if name == "g1":
        from robot_sim.g1.body import g1_body

        return g1_body()
    raise ValueError(f"robot {name!r} is not known; choose one of {', '.join(map(repr, ROBOTS))}")
