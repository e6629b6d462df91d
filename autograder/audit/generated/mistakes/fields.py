"""Mistakes with the fields of messages: left out, copied by hand, of the goal instead of the measurement."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from autograder.audit.generated.messages import Messages, fields, is_list, message_class
from autograder.audit.generated.program import Mistake, Program, last_name


def leaves_a_field_out(program: Program) -> Iterator[Mistake]:
    """A field of a message is not filled in."""
    for put in Messages(program).puts():
        if not _is_a_default(put.value):
            yield Mistake((put.dropped,), f"{put.name} is left as it was")


def copies_some_fields(program: Program) -> Iterator[Mistake]:
    """A message is copied field by field, and some are forgotten."""
    for put, statement, value in Messages(program).copies():
        names = list(fields(message_class(put.type)))
        half = names[: (len(names) + 1) // 2]
        for kept in [half, *([one for one in names if one != left_out] for left_out in names)]:
            missing = ", ".join(name for name in names if name not in kept)
            copied = ", ".join(f"{name}=whole.{name}" for name in kept)
            lines = f"whole = {program.text(value)}", f"{put.name} = type(whole)({copied})"
            yield Mistake(
                (program.replace(statement, ("\n" + " " * statement.col_offset).join(lines)),),
                f"{put.name} is copied field by field, without {missing}",
            )


def collapses_duplicates(program: Program) -> Iterator[Mistake]:
    """What is asked for twice, or is in a list twice, is answered once."""
    messages = Messages(program)
    lists: list[ast.expr] = [
        node
        for node in program.every(ast.Attribute)
        if isinstance(node.ctx, ast.Load)
        and not isinstance(program.parent(node), ast.UnaryOp | ast.If)
        and last_name(program.parent(node)) not in ("set", "bool")
        and (owner := messages.type_of(node.value))
        and owner.__name__.endswith("_Request")
        and _is_plain_list(fields(owner).get(node.attr, ""))
    ]
    lists += [
        put.value
        for put in messages.puts()
        if put.value and _is_plain_list(put.type) and put.how != "element"
    ]
    for node in lists:
        text = program.text(node)
        yield Mistake(
            (program.replace(node, f"list(dict.fromkeys({text}))"),), f"duplicates in {text} are lost"
        )


def answers_with_the_goal(program: Program) -> Iterator[Mistake]:
    """What was asked for is given out as what was measured."""
    messages = Messages(program)
    for put in messages.puts():
        if put.value is None or not message_class(put.type) or "request" in program.text(put.value):
            continue
        for request, its_class in messages.asked(put.value):
            for name, kind in fields(its_class).items():
                if kind == put.type:
                    edit = program.replace(put.value, f"{request}.{name}")
                    yield Mistake((edit,), f"{put.name} is {request}.{name} instead of what was measured")


def _is_plain_list(ros_type: str) -> bool:
    return is_list(ros_type) and "/" not in ros_type


def _is_a_default(value: ast.expr | None) -> bool:
    """Whether a field has this value before anything is put into it."""
    if isinstance(value, ast.Attribute):
        return value.attr == "NONE"  # the course's codes begin with NONE=0
    return isinstance(value, ast.Constant) and not value.value
