"""Finds the values that a program assigns to fields of messages."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass

from autograder.classroom.audit.generated.interfaces import PARTS, element_of, message_class
from autograder.classroom.audit.generated.program import Edits, Program, last_name


@dataclass(frozen=True)
class FieldAssignment:
    """A value that is assigned to a field of a message, or appended to a list in it.

    Attributes:
        field: the target as the program writes it, such as `response.battery`, or the keyword of a constructor.
        type: the value's ROS type; "" if it is not known.
        value: None if the value is unpacked from a tuple.
        removal: the edit that leaves the assignment out.
    """

    field: str
    type: str
    value: ast.expr | None
    removal: Edits


def field_assignments(program: Program) -> Iterator[FieldAssignment]:
    """Yield the values that assignments, `append`, `extend` and constructors assign to fields."""
    types = program.interfaces.types
    for target, value, removal in assignments(program):
        if last_name(target) in types and is_field(target):
            yield FieldAssignment(ast.unparse(target), types[last_name(target)], value, removal)
    for call in program.every(ast.Call):
        into, name = getattr(call.func, "value", call.func), last_name(call)
        if name in program.interfaces.classes or name in PARTS:
            for word in call.keywords:
                yield FieldAssignment(
                    word.arg or "", types.get(word.arg or "", ""), word.value, program.without(word)
                )
        elif name in ("append", "extend") and last_name(into) in types and is_field(into):
            kind = element_of(types[last_name(into)]) if name == "append" else types[last_name(into)]
            yield FieldAssignment(ast.unparse(into), kind, call.args[0], {program.statement(call): "pass"})


def copies(program: Program) -> Iterator[tuple[FieldAssignment, ast.stmt, str]]:
    """Yield each statement that assigns an existing message to a field, with the source of that message."""
    for assigned in field_assignments(program):
        is_made_here = last_name(assigned.value) in {*program.interfaces.classes, *PARTS}
        for changed in (
            assigned.removal if assigned.value and message_class(assigned.type) and not is_made_here else ()
        ):
            if isinstance(changed, ast.Assign):
                yield assigned, changed, ast.unparse(changed.value)


def assignments(program: Program) -> Iterator[tuple[ast.expr, ast.expr | None, Edits]]:
    """Yield each target, its value, and the edit that leaves it out; the value is None if it is unpacked."""
    for statement in program.every(ast.Assign):
        target, value = statement.targets[0], statement.value
        if len(statement.targets) == 1 and isinstance(target, ast.Tuple):
            values = value.elts if isinstance(value, ast.Tuple) else [None] * len(target.elts)
            for one, its_value in zip(target.elts, values, strict=True):
                yield one, its_value, {one: "_"}
        elif len(statement.targets) == 1:
            yield target, value, {statement: "pass"}


def is_field(target: ast.expr) -> bool:
    """Whether a target may be a field of a message: an attribute of anything but `self`."""
    return isinstance(target, ast.Attribute) and last_name(target.value) != "self"
