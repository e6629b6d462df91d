"""Serializes ROS messages as plain CDR, little-endian: the bytes that ROS 2 sends and that MCAP files hold.

Other serializers cannot be used here: rclpy's `serialize_message` ends some messages, such as a JointState without
efforts, with bytes of uninitialized memory, which strict readers reject; mcap-ros2-support rejects the type names of
actions.
"""

from __future__ import annotations

import re
import struct
from collections.abc import Mapping
from functools import cache
from typing import Any

from ros_runtime.messages import is_message, type_name

_HEAD = b"\x00\x01\x00\x00"  # plain CDR, little-endian
_FORMATS: Mapping[str, str] = {
    "boolean": "?",
    "octet": "B",
    "int8": "b",
    "uint8": "B",
    "int16": "h",
    "uint16": "H",
    "int32": "i",
    "uint32": "I",
    "int64": "q",
    "uint64": "Q",
    "float": "f",
    "double": "d",
}
_MANY = re.compile(r"sequence<(?P<element>.+?)(?:, \d+)?>|(?P<of_array>.+)\[\d+\]")
_TEXT = re.compile(r"string(<\d+>)?")


def serialize(message: Any) -> bytes:
    """Return the bytes of a ROS message.

    Raises:
        ValueError, TypeError, struct.error: a field's value does not fit its type.
    """
    out = bytearray()
    _message(out, message)
    return _HEAD + bytes(out)


def _message(out: bytearray, message: Any) -> None:
    fields = message.get_fields_and_field_types()
    if not fields:
        out.append(0)  # CDR has no empty struct
    for name, declared in fields.items():
        _field(out, declared, getattr(message, name))


def _field(out: bytearray, declared: str, value: Any) -> None:
    element, is_sequence = _parsed(declared)
    if element == declared:
        _one(out, element, value)
        return
    if is_sequence:
        _numbers(out, "I", [len(value)])
    if element in _FORMATS:
        _numbers(out, _FORMATS[element], [_plain(each) for each in value])
        return
    for each in value:
        _one(out, element, each)


@cache
def _parsed(declared: str) -> tuple[str, bool]:
    """Return the element type of a sequence or array, and whether its length is variable."""
    match = _MANY.fullmatch(declared)
    if match is None:
        return declared, False
    return match["element"] or match["of_array"], match["element"] is not None


def _one(out: bytearray, declared: str, value: Any) -> None:
    if declared in _FORMATS:
        _numbers(out, _FORMATS[declared], [_plain(value)])
    elif _TEXT.fullmatch(declared):
        text = value.encode() + b"\0"
        _numbers(out, "I", [len(text)])
        out += text
    elif is_message(value) and _short(type_name(value)) == declared:
        _message(out, value)
    else:
        raise ValueError(f"{type(value).__name__} is not a {declared}")


def _numbers(out: bytearray, kind: str, values: list[Any]) -> None:
    """Write numbers, aligned to their size."""
    if values:
        out += bytes(-len(out) % struct.calcsize(f"={kind}"))
        out += struct.pack(f"<{len(values)}{kind}", *values)


def _plain(value: Any) -> Any:
    return value[0] if isinstance(value, bytes) else value  # rclpy represents an octet as bytes of length 1


def _short(name: str) -> str:
    package, _, last = name.split("/")
    return f"{package}/{last}"
