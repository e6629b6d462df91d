"""Converts ROS messages to nested dicts and back, and message types to their names and back."""

from __future__ import annotations

import re
from array import array
from importlib import import_module
from typing import Any

import numpy as np

_TYPE_NAME = re.compile(
    r"([a-z][a-z0-9_]*)/(msg|srv|action)/([A-Z][A-Za-z0-9]*)(?:_(Request|Response|Goal|Result|Feedback))?"
)


def is_message(value: Any) -> bool:
    """Return whether this is a ROS message."""
    return hasattr(value, "get_fields_and_field_types")


def type_name(message: Any) -> str:
    """Return the name of a message's type: 'sensor_msgs/msg/BatteryState', 'std_srvs/srv/Trigger_Response'."""
    package, kind, _ = type(message).__module__.split(".")
    return f"{package}/{kind}/{type(message).__name__}"


def message_type(name: str) -> type:
    """Return the type of that name.

    Raises:
        ValueError: there is no such type.
    """
    parts = _TYPE_NAME.fullmatch(name)
    if parts is None:
        raise ValueError(f"{name[:100]!r} is not the name of a message type")
    package, kind, interface, part = parts.groups()
    try:
        found = getattr(import_module(f"{package}.{kind}"), interface)
        return getattr(found, part) if part else found
    except (ImportError, AttributeError) as error:
        raise ValueError(f"there is no message type {name!r}: {error}") from error


def to_dict(message: Any) -> dict[str, Any]:
    """Return the fields of a message as dicts, lists and plain values; NaN stays NaN, bytes become lists of int."""
    return {name: _plain(getattr(message, name)) for name in message.get_fields_and_field_types()}


def from_dict(message_type: type, values: dict[str, Any], *, strict: bool = False) -> Any:
    """Return a message of `message_type` with the given fields; other fields keep their defaults.

    With `strict`, rosidl checks that each value fits its field; by default it does not check.

    Raises:
        AttributeError: the message has no such field; the error lists its fields.
        AssertionError: with `strict`, a value does not fit its field.
    """
    message = message_type()
    fill(message, values, strict=strict)
    return message


def fill(message: Any, values: dict[str, Any], *, strict: bool = False) -> None:
    """Set fields of a message in place from nested dicts."""
    fields = message.get_fields_and_field_types()
    if strict:
        message._check_fields = True
    for name, value in values.items():
        if name not in fields:
            raise AttributeError(
                f"{type(message).__name__} has no field {name!r}; it has {', '.join(fields)}"
            )
        current = getattr(message, name)
        if is_message(current):
            fill(current, value, strict=strict)
        elif isinstance(current, float):
            setattr(message, name, float(value))
        elif isinstance(value, list) and value and isinstance(value[0], dict):
            element = _element_type(message, name)
            setattr(message, name, [from_dict(element, each, strict=strict) for each in value])
        else:
            setattr(message, name, value)


def _element_type(message: Any, name: str) -> type:
    """Return the Python type of a sequence field's elements ('sequence<geometry_msgs/Point>' → Point)."""
    declared = message.get_fields_and_field_types()[name]
    package, type_name = declared.removeprefix("sequence<").split("[")[0].rstrip(">").split(",")[0].split("/")
    return getattr(import_module(f"{package}.msg"), type_name)


def _plain(value: Any) -> Any:
    if is_message(value):
        return to_dict(value)
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, np.ndarray | array):
        return value.tolist()
    if isinstance(value, bytes | bytearray):
        return list(value)
    if isinstance(value, list | tuple):
        return [_plain(element) for element in value]
    return value
