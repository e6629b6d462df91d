"""Arms collide with the body and with each other."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

from bench.robot.trial import simulate
from robot_sim.arms.joint_trajectory import JointTrajectory, Waypoint
from robot_sim.humanoid import Humanoid
from robot_sim.state import Mode

SOFT = 0.006  # m, contacts give way this far


def clearance(humanoid: Humanoid, one: str, other: str) -> float:
    """Distance of two geoms, m; negative inside each other."""
    model = humanoid.model
    return mujoco.mj_geomDistance(
        model, humanoid.data, model.geom(one).id, model.geom(other).id, 0.5, np.zeros(6)
    )


def both_sides(**left: float) -> dict[str, float]:
    """The angles of both arms from those of the left."""
    signs = {"shoulder_roll": -1, "shoulder_yaw": -1}
    return {
        f"{side}_{name}": angle * (signs.get(name, 1) if side == "r" else 1)
        for name, angle in left.items()
        for side in "lr"
    }


@pytest.mark.parametrize(
    ("angles", "one", "other"),
    [
        ({"r_shoulder_roll": 0.34, "r_elbow": -1.6}, "r_upper_arm", "torso"),
        ({"r_shoulder_yaw": 1.5, "r_elbow": -2.2, "r_shoulder_pitch": -0.2}, "r_forearm", "torso"),
        (
            both_sides(shoulder_roll=-0.3, shoulder_pitch=-1.4, shoulder_yaw=-0.6, elbow=-0.3),
            "l_palm",
            "r_palm",
        ),
        ({"l_shoulder_roll": -0.34, "l_shoulder_pitch": -0.4, "l_elbow": 0.0}, "l_palm", "l_thigh"),
    ],
    ids=["upper arm and chest", "forearm and chest", "both hands", "hand and thigh"],
)
def test_an_arm_is_stopped_by_what_is_in_its_way(angles, one, other):
    humanoid = Humanoid()
    closest = np.inf

    def step_and_look():
        nonlocal closest
        closest = min(closest, clearance(humanoid, one, other))
        return False

    names, positions = tuple(angles), tuple(angles.values())
    humanoid.move_joints(JointTrajectory(names, (Waypoint(1.0, positions, (0.0,) * len(names)),)))
    simulate(humanoid, 2.0, until=step_and_look)
    assert -SOFT < closest < 0.001
    assert humanoid.mode is Mode.STANDING


def test_arms_swing_freely_in_a_walk():
    humanoid = Humanoid()
    humanoid.walk_velocity(0.3, 0.0, 0.0)
    for _ in range(400):
        humanoid.step()
        for contact in humanoid.data.contact:
            met = {humanoid.model.geom(geom).name for geom in contact.geom}
            assert "floor" in met or all(name.endswith("_pad") for name in met)
