"""Finds interfaces by the names that are typed on the command line."""

from __future__ import annotations

from typing import Any

from ros_cli.errors import CommandError
from ros_runtime.messages import message_type

KINDS = {"msg": "message", "srv": "service", "action": "action"}
EXAMPLES = {
    "msg": "geometry_msgs/msg/Twist",
    "srv": "std_srvs/srv/SetBool",
    "action": "humanoid_interfaces/action/WalkTo",
}


def interface_class(name: str, kind: str) -> Any:
    """Return the class of an interface, 'std_srvs/srv/SetBool' or, shorter, 'std_srvs/SetBool'.

    Args:
        name: as it was typed.
        kind: "msg", "srv" or "action".

    Raises:
        CommandError: there is no such interface.
    """
    full = full_type_name(name, kind)
    try:
        found = message_type(full)
    except ValueError as error:
        raise _invalid(kind, str(error)) from error
    if (actual := full.split("/")[1]) != kind:
        raise _invalid(kind, f"{name} is of kind {actual}, not {kind}")
    return found


def full_type_name(name: str, kind: str) -> str:
    """Return 'std_srvs/srv/SetBool' for 'std_srvs/SetBool' of kind "srv"; other names as they are."""
    parts = name.split("/")
    return f"{parts[0]}/{kind}/{parts[1]}" if len(parts) == 2 else name


def _invalid(kind: str, seen: str) -> CommandError:
    return CommandError(
        f"The passed {KINDS[kind]} type is invalid: {seen}; expected a name such as {EXAMPLES[kind]}. "
        "`interface list` shows all"
    )
