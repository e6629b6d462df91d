"""Transforms for /tf. Their type, tf2_msgs/msg/TFMessage, is in no wheel, so its bytes are made here."""

from __future__ import annotations

import struct
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from builtin_interfaces.msg import Time

TF = "/tf"
TF_TYPE = "tf2_msgs/msg/TFMessage"
_LITTLE_ENDIAN = b"\x00\x01\x00\x00"  # the head of plain CDR


@dataclass(frozen=True)
class Transforms:
    """Poses of frames in one other frame: x, y, z (m) and a quaternion (x, y, z, w) for each."""

    stamp: Time
    frame: str
    poses: Mapping[str, Sequence[float]]

    def serialize(self) -> bytes:
        """Return a TFMessage as plain CDR, in which a number begins at a multiple of its size."""
        data = bytearray(struct.pack("<I", len(self.poses)))
        for child, pose in self.poses.items():
            _align(data, 4)
            data += struct.pack("<iI", self.stamp.sec, self.stamp.nanosec)
            for name in (self.frame, child):
                text = name.encode() + b"\0"
                _align(data, 4)
                data += struct.pack("<I", len(text)) + text
            _align(data, 8)
            data += struct.pack("<7d", *pose)
        return _LITTLE_ENDIAN + bytes(data)


def _align(data: bytearray, size: int) -> None:
    data += bytes(-len(data) % size)
