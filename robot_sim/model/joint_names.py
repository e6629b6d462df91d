"""The names of the humanoid's joints, in the order of its actuators.

Every list here is in actuator order, which is also the order of `Humanoid.joint_state()`.
"""

from __future__ import annotations

from robot_sim.model.side import SIDES, Side

LEG = ("hip_yaw", "hip_roll", "hip_pitch", "knee", "ankle_pitch", "ankle_roll")
ARM = ("shoulder_pitch", "shoulder_roll", "shoulder_yaw", "elbow", "wrist_yaw", "wrist_pitch", "wrist_roll")
FINGERS = ("finger_1", "finger_2")

WAIST = ("waist_yaw", "waist_pitch")
HEAD = ("head_pan", "head_tilt")


def leg_joints(side: Side) -> list[str]:
    """Return the names of the six leg joints of a side, hip to ankle."""
    return [f"{side.letter}_{joint}" for joint in LEG]


def arm_joints(side: Side) -> list[str]:
    """Return the names of the seven arm joints of a side, shoulder to wrist."""
    return [f"{side.letter}_{joint}" for joint in ARM]


def finger_joints(side: Side) -> list[str]:
    """Return the names of the two sliding fingers of a hand."""
    return [f"{side.letter}_{joint}" for joint in FINGERS]


LEG_JOINTS = leg_joints(Side.LEFT) + leg_joints(Side.RIGHT)
UPPER_BODY_JOINTS = [
    *WAIST,
    *HEAD,
    *(name for side in SIDES for name in arm_joints(side) + finger_joints(side)),
]
ACTUATED_JOINTS = LEG_JOINTS + UPPER_BODY_JOINTS
