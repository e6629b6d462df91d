"""The size of a trajectory_msgs/JointTrajectory, read from its bytes without deserializing the message."""

from __future__ import annotations

import struct

from robot_sim.arms.joint_trajectory import MOVABLE

MOST_POINTS = 500
MOST_JOINTS = 64  # more than the robot has, so that an unknown name is reported by name
_HEAD_BYTES = 8192  # bytes for the header and the joints' names
_POINT_BYTES = 8 + 4 * (8 + 8 * len(MOVABLE))  # bytes: a duration and four lists, each with its length
MOST_BYTES = _HEAD_BYTES + MOST_POINTS * _POINT_BYTES


def why_too_large(message: bytes) -> str:
    """Return the reason why a trajectory is too large for this robot; "" if it is not too large.

    Raises:
        ValueError: the bytes end too soon.
    """
    joints, points = count_joints_and_points(message)
    if points > MOST_POINTS:
        return f"more than {MOST_POINTS} points"
    if joints > MOST_JOINTS:
        return f"more than {MOST_JOINTS} joints"
    return ""


def count_joints_and_points(message: bytes) -> tuple[int, int]:
    """Return the lengths of `joint_names` and `points` in a serialized message (CDR: OMG formal/02-06-51, 15.3).

    If there are more than `MOST_JOINTS` names, the number of points is not read and is 0.

    Raises:
        ValueError: the bytes end too soon.
    """
    read = struct.Struct("<I" if len(message) > 1 and message[1] & 1 else ">I")

    def number_at(where: int) -> tuple[int, int]:
        """Return the number at the next multiple of four from `where` on, and the position after it."""
        where += -where % 4
        try:
            return read.unpack_from(message, where)[0], where + 4
        except struct.error:
            raise ValueError("the bytes end too soon") from None

    frame_length, where = number_at(4 + 8)  # after encapsulation and stamp
    joints, where = number_at(where + frame_length)
    if joints > MOST_JOINTS:
        return joints, 0
    for _ in range(joints):
        length, where = number_at(where)
        where += length
    points, _ = number_at(where)
    return joints, points
