"""Finds the values that a program assigns to fields of messages."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass

from autograder.classroom.audit.generated.interfaces import PARTS, element_of, message_class
from autograder.classroom.audit.generated.program import Edits, Program, last_name


@dataclass(frozen=True)
class Put:
    """A value that is assigned to a field of a message, or appended to a list in it.

    Attributes:
        place: the field as the program writes it, such as `response.battery`, or its name in a constructor.
        type: of the value, in ROS's words; "" if it is not known.
        value: None where it comes out of a tuple.
        without: leaves the field as it was.
    """

    place: str
    type: str
    value: ast.expr | None
    without: Edits


def puts(program: Program) -> Iterator[Put]:
    """Yield the values that assignments, `append`, `extend` and constructors put into fields."""
    types = program.interfaces.types
    for target, value, without in assignments(program):
        if last_name(target) in types and is_field(target):
            yield Put(ast.unparse(target), types[last_name(target)], value, without)
    for call in program.every(ast.Call):
        into, name = getattr(call.func, "value", call.func), last_name(call)
        if name in program.interfaces.classes or name in PARTS:
            for word in call.keywords:
                yield Put(word.arg or "", types.get(word.arg or "", ""), word.value, program.without(word))
        elif name in ("append", "extend") and last_name(into) in types and is_field(into):
            kind = element_of(types[last_name(into)]) if name == "append" else types[last_name(into)]
            yield Put(ast.unparse(into), kind, call.args[0], {program.statement(call): "pass"})


def copies(program: Program) -> Iterator[tuple[Put, ast.stmt, str]]:
    """Yield each statement that assigns an existing message to a field, and that message."""
    for put in puts(program):
        is_made_here = last_name(put.value) in {*program.interfaces.classes, *PARTS}
        for changed in put.without if put.value and message_class(put.type) and not is_made_here else ():
            if isinstance(changed, ast.Assign):
                yield put, changed, ast.unparse(changed.value)


def assignments(program: Program) -> Iterator[tuple[ast.expr, ast.expr | None, Edits]]:
    """Yield each target with its value, None where the value is no tuple like the targets, and how to leave it out."""
    for statement in program.every(ast.Assign):
        target, value = statement.targets[0], statement.value
        if len(statement.targets) == 1 and isinstance(target, ast.Tuple):
            values = value.elts if isinstance(value, ast.Tuple) else [None] * len(target.elts)
            for one, its_value in zip(target.elts, values, strict=True):
                yield one, its_value, {one: "_"}
        elif len(statement.targets) == 1:
            yield target, value, {statement: "pass"}


def is_field(target: ast.expr) -> bool:
    """Whether it may be a field of a message: an attribute, but none of the node."""
    return isinstance(target, ast.Attribute) and last_name(target.value) != "self"
