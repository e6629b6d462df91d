"""The course's own humanoid, that of humanoid.xml, as one kind of robot."""

from __future__ import annotations

from mujoco import MjData, MjModel

from robot_sim.arms.joint_trajectory import MOVABLE
from robot_sim.body import Body
from robot_sim.model.build import build_model
from robot_sim.model.dimensions import dimensions_of
from robot_sim.model.posture import take_stance
from robot_sim.model.side import SIDES
from robot_sim.walking.balance_gains import trunk_of
from robot_sim.walking.body_height import HeightLimits
from robot_sim.walking.walker import Walker
from robot_sim.walking.walker_parameters import WalkerParameters
from robot_sim.walking.walking_limits import WalkingLimits


def walker_of(model: MjModel, data: MjData, state: MjData | None = None) -> Walker:
    """Make the controller that plans footsteps; it reads the state in `data`, or an estimated one in `state`."""
    return Walker(model, data, state or data, trunk_of(model), WalkerParameters(dimensions_of(model)))


HUMANOID = Body(
    name="humanoid",
    limits=WalkingLimits(),
    heights=HeightLimits(),
    fallen_height=0.38,
    still_speed=0.05,
    model=lambda scene, shape: build_model(scene, shape=shape),
    take_stance=take_stance,
    walker=walker_of,
    movable=MOVABLE,
    hands=SIDES,
    may_rest=True,
)
