"""Mistakes with numbers: rounded, of another unit or sign, unwrapped, limited by axis, counted from another start."""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Iterator
from functools import partial

from autograder.audit.generated.messages import FLOATS, Messages, element_of, floats_in, is_list
from autograder.audit.generated.program import Edit, Mistake, Program, last_name

_STARTS = re.compile(r"start|first|begin|before|initial")
_ANGLES = re.compile(r"angle|yaw|roll|pitch|turn|heading|shoulder|elbow|joint_?state|angular", re.IGNORECASE)

_Change = Callable[[str], str]  # from the source of a number to that of a wrong one


def rounds_a_number(program: Program) -> Iterator[Mistake]:
    """A number is rounded to two decimals where it is put into a message."""
    for name, changed in _numbers(program, of_commands=False):
        yield Mistake((changed("round({}, 2)".format),), f"round(…, 2) around {name}")


def takes_another_unit(program: Program) -> Iterator[Mistake]:
    """A number is put into a message in degrees, percent, centimetres or milliseconds."""
    for name, changed in _numbers(program):
        factor, unit = _other_unit(name)
        yield Mistake((changed(f"{factor} * ({{}})".format),), f"{name} in {unit}")


def turns_the_sign(program: Program) -> Iterator[Mistake]:
    """A number that is put into a message, or a term of a sum of products or coordinates, has the wrong sign."""
    for name, changed in _numbers(program):
        yield Mistake((changed("-({})".format),), f"the sign of {name} is turned")
    for sum_ in program.every(ast.BinOp):
        if isinstance(sum_.op, ast.Add | ast.Sub) and (_is_product(sum_.left) or _is_coordinate(sum_.left)):
            sign = "-" if isinstance(sum_.op, ast.Add) else "+"
            text = f"{program.text(sum_.left)} {sign} ({program.text(sum_.right)})"
            yield Mistake((program.replace(sum_, text),), f"{text} instead of {program.text(sum_)}")


def leaves_an_angle_unwrapped(program: Program) -> Iterator[Mistake]:
    """An angle is not brought back to -π to π."""
    for call in program.every(ast.Call):
        name = last_name(call)
        if not call.args or (angle := call.args[0]) is None:
            continue
        if name.lstrip("_").startswith(("wrap", "normal")) or name == "remainder" or _is_wrapping(call):
            unwrapped = angle.args[0] if isinstance(angle, ast.Call) and name == "atan2" else angle
            edit = program.replace(call, program.text(unwrapped))
            yield Mistake((edit,), f"{program.text(unwrapped)} is not wrapped")


def limits_each_axis(program: Program) -> Iterator[Mistake]:
    """A limit holds for each axis, or for one, instead of for the norm."""
    for call in program.every(ast.Call):
        if last_name(call) in ("hypot", "norm") and len(call.args) > 1:
            sizes = [f"abs({program.text(part)})" for part in call.args]
            for text in (f"max({', '.join(sizes)})", sizes[0], sizes[-1]):
                yield Mistake((program.replace(call, text),), f"{text} instead of {program.text(call)}")


def counts_from_the_start(program: Program) -> Iterator[Mistake]:
    """A count goes on from goal to goal instead of beginning with each."""
    for difference in program.every(ast.BinOp):
        is_count = isinstance(difference.left, ast.Attribute) and _STARTS.search(last_name(difference.right))
        if isinstance(difference.op, ast.Sub) and is_count:
            text = program.text(difference.left)
            yield Mistake((program.replace(difference, text),), f"{text} counts since the robot's start")


def _numbers(
    program: Program, *, of_commands: bool = True
) -> Iterator[tuple[str, Callable[[_Change], Edit]]]:
    """Yield the name of each number with a fraction that is put into a message, and how to change it there."""
    messages = Messages(program)
    for put in messages.puts():
        value = put.value
        if (
            value is None
            or element_of(put.type) not in FLOATS
            or (messages.is_command(put) and not of_commands)
        ):
            continue
        if not isinstance(value, ast.Constant) and last_name(value).lower() not in ("nan", "inf"):
            each = value.elt if isinstance(value, ast.ListComp) else value
            in_list = is_list(put.type) and put.how != "element" and each is value
            yield put.name, partial(_replaced, program, each, "", program.text(each), in_list)
    for put, statement, whole in messages.copies():
        for path, kind in floats_in(put.type):
            name = f"{put.name}.{path}"
            copied = f'{put.name} = __import__("copy").deepcopy({program.text(whole)})'
            start = f"{copied}\n{' ' * statement.col_offset}{name} = "
            yield name, partial(_replaced, program, statement, start, name, is_list(kind))


def _replaced(
    program: Program, node: ast.AST, start: str, number: str, in_list: bool, change: _Change
) -> Edit:
    """Put `start` and the changed number, or each of them, in the place of a node."""
    changed = f"[{change('number')} for number in {number}]" if in_list else change(number)
    return program.replace(node, start + changed)


def _other_unit(name: str) -> tuple[str, str]:
    if "perc" in name:
        return "100", "percent of 100"
    if "time" in name or "sec" in name:
        return "1000", "milliseconds"
    return ("57.29578", "degrees") if _ANGLES.search(name) else ("100", "hundredths")


def _is_product(node: ast.expr) -> bool:
    return isinstance(node, ast.BinOp) and isinstance(node.op, ast.Mult)


def _is_coordinate(node: ast.expr) -> bool:
    return isinstance(node, ast.Attribute) and node.attr in ("x", "y", "z", "w")


def _is_wrapping(call: ast.Call) -> bool:
    """Whether it is atan2(sin(angle), cos(angle))."""
    return last_name(call) == "atan2" and [last_name(part) for part in call.args] == ["sin", "cos"]
