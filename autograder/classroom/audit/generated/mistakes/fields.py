"""Mistakes with the fields of messages: left out, copied by hand, of the goal; numbers rounded, of another unit."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from autograder.classroom.audit.generated.interfaces import (
    FLOATS,
    element_of,
    fields,
    floats_in,
    message_class,
)
from autograder.classroom.audit.generated.program import Edits, Program, last_name
from autograder.classroom.audit.generated.puts import copies, puts

Changes = dict[str, str]  # of numbers, by the first pattern that is found in the name of the field
_ANGLES = "angle|yaw|roll|pitch|turn|heading|shoulder|elbow|joint_?state|angular"
NUMBERS: dict[str, tuple[str, Changes]] = {
    "rounds_a_number": (
        "A number is rounded to two decimals",
        {r"linear|angular\.": "{}", "": "round({}, 2)"},  # which are enough for a velocity that is asked for
    ),
    "takes_another_unit": (
        "A number is in percent, milliseconds, degrees or centimetres",
        {"perc": "100 * ({})", "time|sec": "1000 * ({})", _ANGLES: "57.29578 * ({})", "": "100 * ({})"},
    ),
    "turns_the_sign_of_a_number": ("A number has the wrong sign", {"": "-({})"}),
}


def leaves_a_field_out(program: Program) -> Iterator[Edits]:
    """A field of a message is left as it was."""
    for put in puts(program):
        is_default = isinstance(put.value, ast.Constant) and not put.value.value
        if not is_default and last_name(put.value) != "NONE":  # the course's codes begin with NONE=0
            yield put.without


def copies_some_fields(program: Program) -> Iterator[Edits]:
    """A message is copied field by field, and one field is forgotten."""
    for put, statement, message in copies(program):
        for name in fields(message_class(put.type)):
            copied = f"{put.place} = __import__('copy').deepcopy({message})"
            yield {statement: f"{copied}\n{put.place}.{name} = type({put.place})().{name}"}


def answers_with_the_goal(program: Program) -> Iterator[Edits]:
    """What was asked for is given out as what was measured."""
    goals = [one.Goal for one in program.interfaces.classes.values() if hasattr(one, "Goal")]
    asked = [(name, kind) for goal in goals for name, kind in fields(goal).items() if message_class(kind)]
    for put in puts(program):
        around = program.functions(put.value)[:1] if put.value else ()
        handles = [one.arg for each in around for one in each.args.args if one.arg.endswith("handle")]
        for name in [name for name, kind in asked if kind == put.type and handles]:
            if put.value and "request" not in ast.unparse(put.value):
                yield {put.value: f"{handles[0]}.request.{name}"}


def with_wrong_numbers(program: Program, changes: Changes) -> Iterator[Edits]:
    """Change each number with a fraction that is put into a message."""

    def changed(field: str, number: str, *, is_list: bool) -> str:
        change = next(change for name, change in changes.items() if re.search(name, field.lower()))
        return f"[{change.format('each')} for each in {number}]" if is_list else change.format(number)

    for put in puts(program):
        value = put.value.elt if isinstance(put.value, ast.ListComp) else put.value
        is_constant = isinstance(value, ast.Constant) or last_name(value).lower() in ("nan", "inf")
        is_list = put.type not in FLOATS and value is put.value
        if value and not is_constant and element_of(put.type) in FLOATS:
            yield {value: changed(put.place, ast.unparse(value), is_list=is_list)}
    for put, statement, message in copies(program):
        for path, kind in floats_in(put.type).items():
            field = f"{put.place}.{path}"
            copied = f"{put.place} = __import__('copy').deepcopy({message})"
            yield {statement: f"{copied}\n{field} = {changed(field, field, is_list=kind not in FLOATS)}"}
