"""Mistakes with the numbers that are put into messages: rounded, of another unit, of the wrong sign."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from autograder.classroom.audit.generated.interfaces import FLOATS, element_of, floats_in
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
