"""The posture of a standing robot."""

from __future__ import annotations

import math
from dataclasses import replace

import mujoco

from robot_sim.model.dimensions import Dimensions, dimensions_of
from robot_sim.model.joint_names import UPPER_BODY_JOINTS
from robot_sim.model.side import SIDES, Side

HIPS_AHEAD = 0.014  # m, ahead of the ankles, so that the centre of mass is above the soles' centres
ARMS_AT_REST = {  # rad, left arm; mirrored joints change sign on the right
    "shoulder_pitch": 0.2,
    "shoulder_roll": 0.15,
    "shoulder_yaw": 0.0,
    "elbow": -0.5,
    "wrist_yaw": 0.0,
    "wrist_pitch": 0.0,
    "wrist_roll": 0.0,
}
MIRRORED = {"shoulder_roll", "shoulder_yaw", "wrist_yaw", "wrist_roll"}


def natural_posture(size: Dimensions) -> dict[str, float]:
    """Return every joint's position (rad, fingers m) in stance: knees bent, arms hanging, looking ahead."""
    posture = dict.fromkeys(UPPER_BODY_JOINTS, 0.0)
    hip_height = size.stance_height - size.ankle_height
    knee = 2 * math.acos(math.hypot(hip_height, HIPS_AHEAD) / (size.thigh + size.shank))
    lean = math.atan2(HIPS_AHEAD, hip_height)
    for side in SIDES:
        for joint, angle in ARMS_AT_REST.items():
            posture[f"{side.letter}_{joint}"] = on_side(side, joint, angle)
        posture[f"{side.letter}_hip_pitch"] = lean - knee / 2
        posture[f"{side.letter}_ankle_pitch"] = -lean - knee / 2
        posture[f"{side.letter}_knee"] = knee
    return posture


def on_side(side: Side, joint: str, angle: float) -> float:
    """Return the angle (rad) of an arm's joint on `side` that corresponds to `angle` on the left side."""
    return -angle if side is Side.RIGHT and joint in MIRRORED else angle


def take_stance(
    model: mujoco.MjModel,
    data: mujoco.MjData,
    x: float = 0.0,
    y: float = 0.0,
    yaw: float = 0.0,
    height: float | None = None,
) -> None:
    """Reset the state to standing with the pelvis at (x, y) m, heading `yaw` rad, servos holding.

    `height`: of the pelvis, m; None: as the model has it.
    """
    size = dimensions_of(model)
    if height is not None:
        size = replace(size, stance_height=height)
    mujoco.mj_resetData(model, data)
    half = yaw / 2
    data.joint("root").qpos = [x, y, size.stance_height, math.cos(half), 0, 0, math.sin(half)]
    posture = natural_posture(size)
    for joint, position in posture.items():
        data.joint(joint).qpos = position
    for joint in UPPER_BODY_JOINTS:
        data.actuator(joint).ctrl = posture[joint]
    mujoco.mj_forward(model, data)
