"""Mistakes with the fields of messages: left out, copied by hand, of the goal instead of the measurement."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from autograder.classroom.audit.generated.interfaces import fields, message_class
from autograder.classroom.audit.generated.program import Edits, Program, last_name
from autograder.classroom.audit.generated.puts import copies, puts


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
