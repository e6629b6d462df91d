"""The fields and constants of the interfaces that a program imports, by name."""

from __future__ import annotations

import ast
import importlib
from typing import Any

FLOATS = ("float", "double")
PARTS = ("Request", "Response", "Goal", "Result", "Feedback")

Interface = Any  # the classes that rosidl generates have no type annotations


class Interfaces:
    """The interface classes that one program imports, with their fields and constants.

    Attributes:
        classes: the imported classes, by name.
        types: the ROS type of each field, by the field's name; "" if fields of this name have different types.
    """

    def __init__(self, tree: ast.Module) -> None:
        self.classes: dict[str, Interface] = {
            name.asname or name.name: getattr(importlib.import_module(statement.module), name.name)
            for statement in ast.walk(tree)
            if isinstance(statement, ast.ImportFrom) and statement.module
            if statement.module.endswith((".msg", ".srv", ".action"))
            for name in statement.names
        }
        self.types: dict[str, str] = {}
        self._constants: dict[str, dict[str, int]] = {}
        waiting = list(self.classes.values())
        for one in waiting:  # the loop appends to this list
            inner = [getattr(one, part, None) for part in PARTS] + [*map(message_class, fields(one).values())]
            waiting += [new for new in inner if new and new not in waiting]
            for name, kind in fields(one).items():
                self.types[name] = kind if self.types.get(name, kind) == kind else ""
            numbers = _constants(one)
            self._constants = dict.fromkeys(numbers, numbers) | self._constants

    def other_constants(self, name: str, most: int = 3) -> list[str]:
        """Return up to `most` constants that could be confused with `name`, nearest by value; [] if it is unknown."""
        numbers = self._constants.get(name, {})
        others = sorted(numbers, key=lambda other: (abs(numbers[other] - numbers[name]), other))
        return [other for other in others if other != name][:most]


def fields(interface: Interface) -> dict[str, str]:
    """Return the fields and types of a message, request or other part of an interface; {} for anything else."""
    return dict(getattr(interface, "get_fields_and_field_types", dict)())


def message_class(ros_type: str) -> Interface | None:
    """Return the class of a field's type, such as geometry_msgs/Pose; None for a number, a string or a list."""
    package, slash, name = ros_type.partition("/")
    return getattr(importlib.import_module(f"{package}.msg"), name) if slash and name.isidentifier() else None


def floats_in(ros_type: str, depth: int = 4) -> dict[str, str]:
    """Return the dotted path and type of each floating-point field in a message type."""
    found: dict[str, str] = {}
    for name, kind in fields(message_class(ros_type)).items() if depth else ():
        found |= {name: kind} if element_of(kind) in FLOATS else {}
        found |= {f"{name}.{path}": inner for path, inner in floats_in(kind, depth - 1).items()}
    return found


def element_of(ros_type: str) -> str:
    """Return the element type of a sequence or an array; any other type unchanged."""
    return ros_type.removeprefix("sequence<").split("[")[0].split(",")[0].rstrip(">")


def _constants(interface: Interface) -> dict[str, int]:
    """Return the integer constants of a message class; rosidl keeps the constants in the metaclass."""
    names = [name for name in dir(type(interface)) if name.isupper()] if fields(interface) else []
    return {name: number for name in names if isinstance(number := getattr(interface, name), int)}
