"""The messages of a program, by the classes it imports: what it puts into which of their fields."""

from __future__ import annotations

import ast
import importlib
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Literal

from autograder.audit.generated.callbacks import callbacks
from autograder.audit.generated.program import Edit, Function, Program

FLOATS = ("float", "double")

MessageClass = Any  # a class that rosidl generates carries no types


@dataclass(frozen=True)
class Put:
    """A value that is put into a field; `name` is the field as the program writes it, `type` its type in ROS's words.

    `value` is None where it comes out of a tuple. `dropped` leaves the field as it was. `how` it is put there: an
    element is appended to a list, and a keyword is one of a constructor.
    """

    name: str
    type: str
    value: ast.expr | None
    dropped: Edit
    how: Literal["assigned", "element", "elements", "keyword"] = "assigned"


class Messages:
    """The message classes of a program's imports, and its names for messages."""

    def __init__(self, program: Program) -> None:
        self._program = program
        self._classes = _imported(program)
        self._kept: dict[tuple[Function | None, str], MessageClass] = {}
        for target, value, _ in assignments(program):
            name, known = ast.unparse(target), self.class_of(value) if value else None
            if (
                isinstance(target, ast.Name)
                and program.parent(program.statement(target)) is program.tree
                and known
            ):
                self._classes[name] = known
        self._keep_parameters()
        for target, value, _ in assignments(program):
            if isinstance(value, ast.Call) and _is_message(made := self.class_of(value.func)):
                self._kept[self._scope(target), ast.unparse(target)] = made

    def class_of(self, expression: ast.expr) -> MessageClass | None:
        """Return the class that a name such as WalkTo.Result stands for; None if it is none of an interface."""
        if isinstance(expression, ast.Name):
            return self._classes.get(expression.id)
        if isinstance(expression, ast.Attribute) and (owner := self.class_of(expression.value)):
            inner = getattr(owner, expression.attr, None)
            return inner if isinstance(inner, type) else None
        return None

    def type_of(self, expression: ast.expr) -> MessageClass | None:
        """Return the class of the message that an expression is, as far as the text tells."""
        scopes: list[Function | None] = [*self._program.functions(expression), None]
        for scope in scopes:
            if found := self._kept.get((scope, ast.unparse(expression))):
                return found
        if isinstance(expression, ast.Attribute) and (owner := self.type_of(expression.value)):
            return message_class(fields(owner).get(expression.attr, ""))
        return None

    def asked(self, place: ast.AST) -> Iterator[tuple[str, MessageClass]]:
        """Yield the requests and goals that are known at a place, each with its class."""
        around = self._program.functions(place)
        for (function, name), kept in self._kept.items():
            is_own = kept.__name__.endswith("_Goal") and not name.endswith(".request")  # which a client sends
            if function in around and kept.__name__.endswith(("_Goal", "_Request")) and not is_own:
                yield name, kept

    def puts(self) -> Iterator[Put]:
        """Yield what is put into messages, by assignments, `append` and `extend`, and constructors."""
        program = self._program
        for target, value, dropped in assignments(program):
            if isinstance(target, ast.Attribute) and (owner := self.type_of(target.value)):
                yield Put(program.text(target), fields(owner).get(target.attr, ""), value, dropped)
        for call in program.every(ast.Call):
            if _is_message(owner := self.class_of(call.func)):
                for word in call.keywords:
                    if word.arg in (kinds := fields(owner)):
                        name, kind = f"{program.text(call.func)}.{word.arg}", kinds[word.arg or ""]
                        yield Put(name, kind, word.value, program.without(word), "keyword")
            elif (
                isinstance(call.func, ast.Attribute) and call.func.attr in ("append", "extend") and call.args
            ):
                into, statement = call.func.value, program.statement(call)
                if isinstance(into, ast.Attribute) and (owner := self.type_of(into.value)):
                    kind, how = fields(owner).get(into.attr, ""), call.func.attr
                    yield Put(
                        program.text(into),
                        kind,
                        call.args[0],
                        program.drop(statement),
                        "element" if how == "append" else "elements",
                    )

    def copies(self) -> Iterator[tuple[Put, ast.stmt, ast.expr]]:
        """Yield where a statement puts a whole message, which it has from elsewhere, into a field."""
        for put in self.puts():
            statement = put.dropped.node
            if put.how != "assigned" or not isinstance(statement, ast.Assign) or not message_class(put.type):
                continue
            if not (isinstance(statement.value, ast.Call) and self.class_of(statement.value.func)):
                yield put, statement, statement.value

    def is_command(self, put: Put) -> bool:
        """Whether a value is put into a velocity, of which two decimals are enough."""
        root = put.name.split(".linear.")[0].split(".angular.")[0]
        return any(name == root and kept.__name__ == "Twist" for (_, name), kept in self._kept.items())

    def _keep_parameters(self) -> None:
        """Learn the types of the callbacks' parameters."""
        for callback in callbacks(self._program):
            interface = self.class_of(callback.interface) if callback.interface else None
            parts: dict[str, tuple[str, ...]] = {"service": ("Request", "Response"), "goal": ("Goal",)}
            names = parts.get(callback.kind, ())
            if interface and callback.kind == "subscription":
                self._kept.update({(callback.function, name): interface for name in callback.parameters[:1]})
            elif interface and callback.kind == "execute":
                self._keep_handle(callback.parameters[0], interface.Goal)
            for name, part in zip(callback.parameters, names, strict=False) if interface else ():
                self._kept[callback.function, name] = getattr(interface, part)

    def _keep_handle(self, name: str, goal: MessageClass) -> None:
        """Let the execute callback's parameter be a goal handle wherever a function takes one of that name."""
        for function in self._program.named_functions():
            if name in (parameter.arg for parameter in function.args.args):
                self._kept[function, f"{name}.request"] = goal

    def _scope(self, target: ast.expr) -> Function | None:
        """Return the function in which a name is known; None for what is kept in an object."""
        around = self._program.functions(target)
        return around[0] if around and isinstance(target, ast.Name) else None


def assignments(program: Program) -> Iterator[tuple[ast.expr, ast.expr | None, Edit]]:
    """Yield each target with its value, None where the value is no tuple like the targets, and how to leave it out."""
    for statement in program.every(ast.Assign):
        if len(statement.targets) != 1:
            continue
        (target,), value = statement.targets, statement.value
        if not isinstance(target, ast.Tuple):
            yield target, value, program.drop(statement)
            continue
        values: list[ast.expr] | list[None] = [None] * len(target.elts)
        if isinstance(value, ast.Tuple) and len(value.elts) == len(target.elts):
            values = value.elts
        for one, its_value in zip(target.elts, values, strict=True):
            yield one, its_value, program.replace(one, "_")


def message_class(ros_type: str) -> MessageClass | None:
    """Return the class of a field's type, such as geometry_msgs/Pose; None for a number, a text or a list."""
    package, slash, name = ros_type.partition("/")
    if not slash or not name.isidentifier():
        return None
    return getattr(importlib.import_module(f"{package}.msg"), name)


def fields(message: MessageClass) -> dict[str, str]:
    """Return the fields of a message class with their types."""
    return dict(message.get_fields_and_field_types()) if _is_message(message) else {}


def constants(message: MessageClass) -> dict[str, object]:
    """Return the constants of a message class, which rosidl keeps in its metaclass."""
    names = [name for name in dir(type(message)) if name.isupper() and not name.startswith("_")]
    return {name: getattr(message, name) for name in names} if _is_message(message) else {}


def other_constants(message: MessageClass, name: str, most: int = 3) -> list[str]:
    """Return a few constants that may be taken for one, nearest by value; none if the message has no such one."""
    values = {other: number for other, number in constants(message).items() if isinstance(number, int)}
    if (value := values.pop(name, None)) is None:
        return []
    return sorted(values, key=lambda other: (abs(values[other] - value), other))[:most]


def floats_in(ros_type: str, depth: int = 4) -> Iterator[tuple[str, str]]:
    """Yield the dotted path and type of each number with a fraction that a message type holds."""
    for name, kind in fields(message_class(ros_type)).items() if depth else ():
        if element_of(kind) in FLOATS:
            yield name, kind
        for path, inner in floats_in(kind, depth - 1):
            yield f"{name}.{path}", inner


def element_of(ros_type: str) -> str:
    """Return the type of the elements of a sequence or an array; any other type as it is."""
    return ros_type.removeprefix("sequence<").split("[")[0].split(",")[0].rstrip(">")


def is_list(ros_type: str) -> bool:
    """Whether a field's type is a sequence or an array."""
    return ros_type.startswith("sequence<") or ros_type.endswith("]")


def _imported(program: Program) -> dict[str, MessageClass]:
    found: dict[str, MessageClass] = {}
    for statement in program.every(ast.ImportFrom):
        if (statement.module or "").endswith((".msg", ".srv", ".action")):
            module = importlib.import_module(statement.module or "")
            found |= {name.asname or name.name: getattr(module, name.name) for name in statement.names}
    return found


def _is_message(found: object) -> bool:
    return hasattr(found, "get_fields_and_field_types")
