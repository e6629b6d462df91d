"""Formats ROS messages as one readable line."""

from __future__ import annotations

import math
from typing import Any

from builtin_interfaces.msg import Duration, Time
from geometry_msgs.msg import Pose, PoseStamped

from ros_runtime.angles import yaw_of
from ros_runtime.messages import is_message


def describe(message: Any) -> str:
    """Format the fields of a message in one line: numbers with three digits, no headers, poses as x, y, heading."""
    return ", ".join(f"{name} {_value(value)}" for name, value in _fields(message)) or "empty"


def describe_briefly(message: Any) -> str:
    """Format a message for diagrams, shorter than `describe`: without zero or empty fields and pose field names."""
    fields = [(name, value) for name, value in _fields(message) if _is_informative(value)]
    parts = [_value(value) if _is_pose(value) else f"{name} {_value(value)}" for name, value in fields]
    return ", ".join(parts) or describe(message)


def fixed(value: float, digits: int) -> str:
    """Format a number with `digits` decimals and without a minus sign before zero."""
    return f"{round(value, digits) + 0.0:.{digits}f}"  # adding 0.0 turns -0.0 into 0.0


def _fields(message: Any) -> list[tuple[str, Any]]:
    return [
        (name, getattr(message, name))
        for name in message.get_fields_and_field_types()
        if name not in ("header", "structure_needs_at_least_one_member")
    ]


def _is_informative(value: Any) -> bool:
    if is_message(value):
        return any(_is_informative(part) for _, part in _fields(value))
    return len(value) > 0 if hasattr(value, "__len__") else bool(value)


def _value(value: Any) -> str:
    if is_message(value):
        return _nested(value)
    if isinstance(value, bool):
        return str(value)
    if isinstance(value, float):
        return "NaN" if math.isnan(value) else f"{value:.3g}"
    if isinstance(value, str):
        return repr(value)
    if hasattr(value, "__len__"):
        return f"[{len(value)} values]" if len(value) > 3 else f"[{', '.join(_value(v) for v in value)}]"
    return str(value)


def _nested(message: Any) -> str:
    if _is_pose(message):
        pose = getattr(message, "pose", message)
        p, q = pose.position, pose.orientation
        yaw = yaw_of(q.x, q.y, q.z, q.w)
        return f"({fixed(p.x, 2)} m, {fixed(p.y, 2)} m, {fixed(math.degrees(yaw), 0)}°)"
    if isinstance(message, Duration | Time):
        return f"{message.sec + message.nanosec * 1e-9:.1f} s"
    return f"({describe(message)})"


def _is_pose(value: Any) -> bool:
    return isinstance(value, Pose | PoseStamped)
