"""Transforms for /tf; their message type is missing in the ROS wheels, so it is defined here."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from builtin_interfaces.msg import Time
from geometry_msgs.msg import TransformStamped

TF = "/tf"
TF_TYPE = "tf2_msgs/msg/TFMessage"


class TFMessage:
    """The message tf2_msgs/msg/TFMessage, with only the members that serialization needs."""

    __module__ = "tf2_msgs.msg._tf_message"  # where the generated class is

    def __init__(self, transforms: Sequence[TransformStamped] = ()) -> None:
        self.transforms = list(transforms)

    @classmethod
    def get_fields_and_field_types(cls) -> dict[str, str]:
        """Return the fields with their types, like a generated message class."""
        return {"transforms": "sequence<geometry_msgs/TransformStamped>"}


def transforms(stamp: Time, frame: str, poses: Mapping[str, Sequence[float]]) -> TFMessage:
    """Return the poses of frames in another one: x, y, z (m) and a quaternion (x, y, z, w) for each."""
    message = TFMessage()
    for child, pose in poses.items():
        stamped = TransformStamped(child_frame_id=child)
        stamped.header.stamp, stamped.header.frame_id = stamp, frame
        moved, turned = stamped.transform.translation, stamped.transform.rotation
        moved.x, moved.y, moved.z, turned.x, turned.y, turned.z, turned.w = map(float, pose)
        message.transforms.append(stamped)
    return message
