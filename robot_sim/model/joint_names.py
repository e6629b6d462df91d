"""The names of the humanoid's joints, in the order of its actuators.

Every list here is in actuator order, which is also the order of ``Humanoid.joint_state()``.
"""

LEFT, RIGHT = 0, 1
SIDES = ("l", "r")

LEG = ("hip_yaw", "hip_roll", "hip_pitch", "knee", "ankle_pitch", "ankle_roll")
ARM = ("shoulder_pitch", "shoulder_roll", "shoulder_yaw", "elbow", "wrist_yaw", "wrist_pitch", "wrist_roll")
FINGERS = ("finger_1", "finger_2")

WAIST = ("waist_yaw", "waist_pitch")
HEAD = ("head_pan", "head_tilt")


def leg_joints(side: str) -> list[str]:
    """The six leg joints of a side ("l" or "r"), hip to ankle."""
    return [f"{side}_{joint}" for joint in LEG]


def arm_joints(side: str) -> list[str]:
    """The seven arm joints of a side ("l" or "r"), shoulder to wrist."""
    return [f"{side}_{joint}" for joint in ARM]


def finger_joints(side: str) -> list[str]:
    """The two sliding fingers of a hand ("l" or "r")."""
    return [f"{side}_{joint}" for joint in FINGERS]


LEG_JOINTS = leg_joints("l") + leg_joints("r")
UPPER_BODY_JOINTS = [
    *WAIST,
    *HEAD,
    *(name for side in SIDES for name in arm_joints(side) + finger_joints(side)),
]
ACTUATED_JOINTS = LEG_JOINTS + UPPER_BODY_JOINTS
