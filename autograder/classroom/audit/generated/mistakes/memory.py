"""Mistakes with a program's variables: not reset, kept from the first message, or discarded too early."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from autograder.classroom.audit.generated.field_assignments import assignments, is_field
from autograder.classroom.audit.generated.program import Edits, Program, callbacks, last_name

_RESET_VALUES = ("0", "0.0", "False", "None", "''", "[]", "()", "{}")
_MAX_AGE = 5.0  # s, of a message that is still used
_CLOCK = "__import__('time').monotonic()"


def forgets_a_reset(program: Program) -> Iterator[Edits]:
    """A variable that belongs to one request or goal is not reset for the next."""
    begun: set[tuple[object, ...]] = set()
    for target, value, dropped in assignments(program):
        name, around = ast.unparse(target), program.functions(target)[:1]
        is_reset = not isinstance(target, ast.Name) or (*around, name) in begun
        begun.add((*around, name))
        if (
            is_reset
            and value
            and around
            and not is_field(target)
            and program.function_name(target) != "__init__"
        ):
            if ast.unparse(value) in _RESET_VALUES:
                yield dropped
            elif isinstance(value, ast.IfExp) and ast.unparse(value.orelse) in _RESET_VALUES:
                yield {value.orelse: name}
    for statement in program.every(ast.Expr):
        if last_name(statement.value) == "clear":
            yield {statement: "pass"}


def keeps_the_first_message(program: Program) -> Iterator[Edits]:
    """A subscription callback keeps the first message instead of the latest."""
    for callback in callbacks(program, "subscription"):
        yield program.begun_with(callback, "if globals().get('came'):\n    return\nglobals()['came'] = True")


def forgets_what_is_old(program: Program) -> Iterator[Edits]:
    """A message that is older than 5 s is ignored."""
    attributes = [(one, value) for one, value, _ in assignments(program) if isinstance(one, ast.Attribute)]
    unknown = {ast.unparse(one) for one, value in attributes if value and ast.unparse(value) == "None"}
    for keeping in callbacks(program, "subscription"):
        for statement in program.every(ast.Assign, keeping):
            name = ast.unparse(statement.targets[0])
            for asking in callbacks(program, "service", "goal") if name in unknown else ():
                if program.parent(asking) is program.parent(keeping):
                    old = f"{name} is not None and {_CLOCK} - {name}_came > {_MAX_AGE}"
                    came = f"{name}_came = {_CLOCK}\n{ast.unparse(statement)}"
                    yield program.begun_with(asking, f"if {old}:\n    {name} = None") | {statement: came}
