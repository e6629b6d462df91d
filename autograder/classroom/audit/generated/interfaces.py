"""The fields and constants of the interfaces that a program imports, by their names."""

from __future__ import annotations

import ast
import importlib
from typing import Any

FLOATS = ("float", "double")
PARTS = ("Request", "Response", "Goal", "Result", "Feedback")

Interface = Any  # a class that rosidl generates carries no types


class Interfaces:
    """What the names in one program stand for.

    Attributes:
        classes: the imported classes, by name.
        types: the types of fields in ROS's words, by name; "" where two fields of one name have different ones.
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
        for one in waiting:  # grows as it goes
            inner = [getattr(one, part, None) for part in PARTS] + [*map(message_class, fields(one).values())]
            waiting += [new for new in inner if new and new not in waiting]
            for name, kind in fields(one).items():
                self.types[name] = kind if self.types.get(name, kind) == kind else ""
            numbers = _constants(one)
            self._constants = dict.fromkeys(numbers, numbers) | self._constants

    def other_constants(self, name: str, most: int = 3) -> list[str]:
        """Return a few constants that may be taken for one, nearest by value; none if no interface has it."""
        numbers = self._constants.get(name, {})
        others = sorted(numbers, key=lambda other: (abs(numbers[other] - numbers[name]), other))
        return [other for other in others if other != name][:most]


def fields(interface: Interface) -> dict[str, str]:
    """Return the fields of a message, a request or another part with their types; none for anything else."""
    return dict(getattr(interface, "get_fields_and_field_types", dict)())


def message_class(ros_type: str) -> Interface | None:
    """Return the class of a field's type, such as geometry_msgs/Pose; None for a number, a text or a list."""
    package, slash, name = ros_type.partition("/")
    return getattr(importlib.import_module(f"{package}.msg"), name) if slash and name.isidentifier() else None


def floats_in(ros_type: str, depth: int = 4) -> dict[str, str]:
    """Return the dotted path and type of each number with a fraction that a message type holds."""
    found: dict[str, str] = {}
    for name, kind in fields(message_class(ros_type)).items() if depth else ():
        found |= {name: kind} if element_of(kind) in FLOATS else {}
        found |= {f"{name}.{path}": inner for path, inner in floats_in(kind, depth - 1).items()}
    return found


def element_of(ros_type: str) -> str:
    """Return the type of the elements of a sequence or an array; any other type as it is."""
    return ros_type.removeprefix("sequence<").split("[")[0].split(",")[0].rstrip(">")


def _constants(interface: Interface) -> dict[str, int]:
    """Return the whole numbers among the constants of a message class, which rosidl keeps in its metaclass."""
    names = [name for name in dir(type(interface)) if name.isupper()] if fields(interface) else []
    return {name: number for name in names if isinstance(number := getattr(interface, name), int)}
