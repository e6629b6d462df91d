"""Mistakes with what a program remembers: not reset, of the first message, thrown away too early."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from autograder.audit.generated.callbacks import callbacks
from autograder.audit.generated.program import Edits, Program, last_name
from autograder.audit.generated.puts import assignments

_BLANK = ("0", "0.0", "False", "None", "''", "[]", "()", "{}")
_AGE = 5.0  # s, after which a message is taken for too old
_CLOCK = "__import__('time').monotonic()"


def forgets_a_reset(program: Program) -> Iterator[Edits]:
    """What belongs to one request or goal is not reset for the next."""
    begun: set[tuple[object, ...]] = set()
    for target, value, dropped in assignments(program):
        name, function = ast.unparse(target), program.functions(target)[:1]
        is_first = isinstance(target, ast.Name) and (*function, name) not in begun
        begun.add((*function, name))
        is_of_a_message = isinstance(target, ast.Attribute) and last_name(target.value) != "self"
        if (
            is_first
            or is_of_a_message
            or program.function_name(target) in ("__init__", "module")
            or not value
        ):
            continue
        if ast.unparse(value) in _BLANK:
            yield dropped
        elif isinstance(value, ast.IfExp) and ast.unparse(value.orelse) in _BLANK:
            yield {value.orelse: name}
    for statement in program.every(ast.Expr):
        if last_name(statement.value) == "clear":
            yield {statement: "pass"}


def keeps_the_first_message(program: Program) -> Iterator[Edits]:
    """A subscription callback keeps the first message instead of the last."""
    for callback in callbacks(program, "subscription"):
        yield program.begun_with(callback, "if globals().get('came'):\n    return\nglobals()['came'] = True")


def forgets_what_is_old(program: Program) -> Iterator[Edits]:
    """A message counts as none when it is older than 5 s."""
    unknown = {ast.unparse(target) for target, value, _ in assignments(program) if _is_none(value)}
    for keeping in callbacks(program, "subscription"):
        for statement in program.every(ast.Assign, keeping):
            name = ast.unparse(statement.targets[0])
            for asking in callbacks(program, "service", "goal") if name in unknown else ():
                if program.parent(asking) is program.parent(keeping):
                    old = f"{name} is not None and {_CLOCK} - {name}_came > {_AGE}"
                    came = f"{name}_came = {_CLOCK}\n{ast.unparse(statement)}"
                    yield program.begun_with(asking, f"if {old}:\n    {name} = None") | {statement: came}


def _is_none(value: ast.expr | None) -> bool:
    return isinstance(value, ast.Constant) and value.value is None
