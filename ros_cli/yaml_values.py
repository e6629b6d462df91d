"""Converts the YAML of the command line to messages, and messages to YAML for printing."""

from __future__ import annotations

import re
import sys
from importlib import import_module
from typing import Any

import yaml
from builtin_interfaces.msg import Time

from ros_cli.errors import CommandError
from ros_runtime.messages import to_dict, type_name

# 'sequence<double>', 'sequence<geometry_msgs/Point, 3>', 'double[36]': the type of the elements.
_ELEMENTS = re.compile(r"sequence<(.+?)(?:, \d+)?>|(.+)\[\d+\]")


def message_from_yaml(message_type: Any, text: str, *, now: Time | None = None) -> Any:
    """Return a message with the fields in `text`, such as '{linear: {x: 0.2}}'; others keep their defaults.

    The value "auto" of a header stands for one with the time `now`, and the value "now" of a time for `now`. The
    default of `now` is 0.

    Raises:
        CommandError: the text is not YAML, there is no such field, or a value does not fit its field.
    """
    message = message_type()
    try:
        _fill(message, _mapping(text), now or Time())
    except (AttributeError, AssertionError, TypeError, ValueError, OverflowError) as error:
        raise CommandError(f"Failed to populate field: {error}") from error
    return message


def message_to_yaml(message: Any, *, longest: int | None = None) -> str:
    """Return a message as YAML, field by field; strings and sequences longer than `longest` end with '...'."""
    return yaml.dump(
        _shortened(to_dict(message), longest),
        sort_keys=False,
        allow_unicode=True,
        width=sys.maxsize,
        default_flow_style=False,
    )


def _mapping(text: str) -> dict[str, Any]:
    """Return the fields in a text.

    Raises:
        CommandError: the text is not YAML, or holds something else.
    """
    try:
        values = yaml.safe_load(text)
    except yaml.YAMLError as error:
        raise CommandError(
            f"{text!r} is not YAML: {error}\nExpected fields in braces, such as '{{x: 1.0}}', in quotes"
        ) from error
    if values is None:
        return {}
    if not isinstance(values, dict):
        raise CommandError(
            "The passed value needs to be a dictionary in YAML format: "
            f"expected fields such as '{{x: 1.0}}', got {text!r}"
        )
    return values


def _fill(message: Any, values: dict[str, Any], now: Time) -> None:
    message._check_fields = True  # otherwise rosidl sends a value of the wrong type as garbage
    declared = message.get_fields_and_field_types()
    for name, value in values.items():
        if name not in declared:
            raise AttributeError(_no_such_field(message, str(name)))
        setattr(message, name, _converted(name, value, declared[name], now))


def _no_such_field(message: Any, name: str) -> str:
    fields = ", ".join(message.get_fields_and_field_types()) or "no fields"
    advice = "; in YAML a space follows each colon" if ":" in name else ""
    return f"{type_name(message)} has no field {name!r}; it has {fields}{advice}"


def _converted(name: str, value: Any, declared: str, now: Time) -> Any:
    """Convert a value of YAML to the type of its field: 1 becomes 1.0 for a float, 5 becomes '5' for a string."""
    elements = _ELEMENTS.fullmatch(declared)
    if elements and isinstance(value, list):
        element = elements[1] or elements[2]
        return [_converted(name, each, element, now) for each in value]
    if elements:
        return value
    if "/" in declared:
        return _nested(name, value, declared, now)
    if declared in ("float", "double"):
        return _number(name, value)
    if declared.startswith(("string", "wstring")):
        return value if isinstance(value, str) else str(value)
    return bool(value) if declared == "boolean" and value in (0, 1) else value


def _number(name: str, value: Any) -> float:
    try:
        return float(value)
    except (TypeError, ValueError):
        raise ValueError(f"{name} is a number, got {value!r}") from None


def _nested(name: str, value: Any, declared: str, now: Time) -> Any:
    package, message_name = declared.split("/")
    message = getattr(import_module(f"{package}.msg"), message_name)()
    if (declared, value) == ("builtin_interfaces/Time", "now"):
        return now
    if (declared, value) == ("std_msgs/Header", "auto"):
        message.stamp = now
        return message
    if not isinstance(value, dict):
        fields = ", ".join(f"{field}: …" for field in message.get_fields_and_field_types())
        raise TypeError(f"{name} is a {declared}, expected {{{fields}}}, got {value!r}")
    _fill(message, value, now)
    return message


def _shortened(value: Any, longest: int | None) -> Any:
    if longest is None:
        return value
    if isinstance(value, dict):
        return {name: _shortened(each, longest) for name, each in value.items()}
    if isinstance(value, list):
        rest = ["..."] if len(value) > longest else []
        return [_shortened(each, longest) for each in value[:longest]] + rest
    if isinstance(value, str) and len(value) > longest:
        return value[:longest] + "..."
    return value
