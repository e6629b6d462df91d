"""Mistakes with the numbers that are put into messages: rounded, of another unit, of the wrong sign."""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Iterator

from autograder.audit.generated.interfaces import FLOATS, element_of, floats_in
from autograder.audit.generated.program import Edits, Program, last_name
from autograder.audit.generated.puts import copies, puts

_COMMAND = re.compile(r"linear|angular\.")  # of which two decimals are enough
_OTHER_UNITS = {  # by the first pattern that is found in the name of a field
    "perc": 100,  # instead of a share
    "time|sec": 1000,  # ms
    "angle|yaw|roll|pitch|turn|heading|shoulder|elbow|joint_?state|angular": 57.29578,  # degrees
    "": 100,  # cm
}


def rounds_a_number(program: Program) -> Iterator[Edits]:
    """A number is rounded to two decimals."""
    yield from _changed(program, lambda name, number: "" if _COMMAND.search(name) else f"round({number}, 2)")


def turns_the_sign_of_a_number(program: Program) -> Iterator[Edits]:
    """A number has the wrong sign."""
    yield from _changed(program, lambda name, number: f"-({number})")


def takes_another_unit(program: Program) -> Iterator[Edits]:
    """A number is in degrees, percent, centimetres or milliseconds."""

    def in_another_unit(name: str, number: str) -> str:
        factor = next(factor for words, factor in _OTHER_UNITS.items() if re.search(words, name.lower()))
        return f"{factor} * ({number})"

    yield from _changed(program, in_another_unit)


def _changed(program: Program, change: Callable[[str, str], str]) -> Iterator[Edits]:
    """Change each number with a fraction that is put into a message, unless `change` of its name and source is ""."""

    def changed(name: str, number: str, *, is_list: bool) -> str:
        wrong = change(name, "each" if is_list else number)
        return f"[{wrong} for each in {number}]" if is_list and wrong else wrong

    for put in puts(program):
        is_computed = not isinstance(put.value, ast.Constant) and last_name(put.value).lower() not in (
            "nan",
            "inf",
        )
        if put.value and is_computed and element_of(put.type) in FLOATS:
            each = put.value.elt if isinstance(put.value, ast.ListComp) else put.value
            is_list = put.type not in FLOATS and each is put.value
            if wrong := changed(put.place, ast.unparse(each), is_list=is_list):
                yield {each: wrong}
    for put, statement, message in copies(program):
        for field, kind in [(f"{put.place}.{path}", kind) for path, kind in floats_in(put.type).items()]:
            if wrong := changed(field, field, is_list=kind not in FLOATS):
                copied = f"{put.place} = __import__('copy').deepcopy({message})"
                yield {statement: f"{copied}\n{field} = {wrong}"}
