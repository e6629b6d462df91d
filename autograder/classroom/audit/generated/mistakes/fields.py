"""Mistakes with fields of messages: left out, copied by hand or taken from the goal; wrong rounding, unit or sign."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from autograder.classroom.audit.generated.field_assignments import copies, field_assignments
from autograder.classroom.audit.generated.interfaces import (
    FLOATS,
    element_of,
    fields,
    floats_in,
    message_class,
)
from autograder.classroom.audit.generated.program import Edits, Program, last_name

Changes = dict[str, str]  # how to change a number: the first pattern found in the field's name decides
_ANGLES = "angle|yaw|roll|pitch|turn|heading|shoulder|elbow|joint_?state|angular"
NUMBERS: dict[str, tuple[str, Changes]] = {
    "rounds_a_number": (
        "A number is rounded to two decimals",
        {r"linear|angular\.": "{}", "": "round({}, 2)"},  # two decimals are enough for a commanded velocity
    ),
    "takes_another_unit": (
        "A number is in percent, milliseconds, degrees or centimetres",
        {"perc": "100 * ({})", "time|sec": "1000 * ({})", _ANGLES: "57.29578 * ({})", "": "100 * ({})"},
    ),
    "turns_the_sign_of_a_number": ("A number has the wrong sign", {"": "-({})"}),
}


def leaves_a_field_out(program: Program) -> Iterator[Edits]:
    """A field of a message is not set."""
    for assigned in field_assignments(program):
        is_default = isinstance(assigned.value, ast.Constant) and not assigned.value.value
        if not is_default and last_name(assigned.value) != "NONE":  # the course's codes begin with NONE=0
            yield assigned.removal


def copies_some_fields(program: Program) -> Iterator[Edits]:
    """A message is copied field by field, and one field is forgotten."""
    for assigned, statement, message in copies(program):
        for name in fields(message_class(assigned.type)):
            copied = f"{assigned.field} = __import__('copy').deepcopy({message})"
            yield {statement: f"{copied}\n{assigned.field}.{name} = type({assigned.field})().{name}"}


def answers_with_the_goal(program: Program) -> Iterator[Edits]:
    """A value of the goal is reported as the measured value."""
    goals = [one.Goal for one in program.interfaces.classes.values() if hasattr(one, "Goal")]
    asked = [(name, kind) for goal in goals for name, kind in fields(goal).items() if message_class(kind)]
    for assigned in field_assignments(program):
        around = program.functions(assigned.value)[:1] if assigned.value else ()
        handles = [one.arg for each in around for one in each.args.args if one.arg.endswith("handle")]
        for name in [name for name, kind in asked if kind == assigned.type and handles]:
            if assigned.value and "request" not in ast.unparse(assigned.value):
                yield {assigned.value: f"{handles[0]}.request.{name}"}


def with_wrong_numbers(program: Program, changes: Changes) -> Iterator[Edits]:
    """Change each floating-point number that is assigned to a field of a message."""

    def changed(field: str, number: str, *, is_list: bool) -> str:
        change = next(change for name, change in changes.items() if re.search(name, field.lower()))
        return f"[{change.format('each')} for each in {number}]" if is_list else change.format(number)

    for assigned in field_assignments(program):
        value = assigned.value.elt if isinstance(assigned.value, ast.ListComp) else assigned.value
        is_constant = isinstance(value, ast.Constant) or last_name(value).lower() in ("nan", "inf")
        is_list = assigned.type not in FLOATS and value is assigned.value
        if value and not is_constant and element_of(assigned.type) in FLOATS:
            yield {value: changed(assigned.field, ast.unparse(value), is_list=is_list)}
    for assigned, statement, message in copies(program):
        for path, kind in floats_in(assigned.type).items():
            field = f"{assigned.field}.{path}"
            copied = f"{assigned.field} = __import__('copy').deepcopy({message})"
            yield {statement: f"{copied}\n{field} = {changed(field, field, is_list=kind not in FLOATS)}"}
