"""Mistakes with what a program remembers: not reset, of the first message, thrown away too early."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from autograder.audit.generated.callbacks import callbacks
from autograder.audit.generated.messages import Messages, assignments
from autograder.audit.generated.program import Mistake, Program

_AGE = 5.0  # s, after which a message is taken for too old


def forgets_a_reset(program: Program) -> Iterator[Mistake]:
    """What belongs to one request or goal is not reset for the next."""
    messages = Messages(program)
    seen: set[tuple[object, str]] = set()
    for target, value, dropped in assignments(program):
        name, around = program.text(target), program.functions(target)
        in_message = isinstance(target, ast.Attribute) and messages.type_of(target.value)
        if program.function_name(target) == "__init__" or not around or in_message:
            continue
        is_first = isinstance(target, ast.Name) and (around[0], name) not in seen
        seen.add((around[0], name))
        if is_first and name not in _names_from_outside(program, around[0]):
            continue
        if value is not None and _is_blank(value):
            yield Mistake((dropped,), f"{name} is not reset to {program.text(value)}")
        elif isinstance(value, ast.IfExp) and _is_blank(value.orelse):
            yield Mistake(
                (program.replace(value.orelse, name),), f"{name} is not reset when {program.text(value)}"
            )
    for statement in program.every(ast.Expr):
        call = statement.value
        if isinstance(call, ast.Call) and isinstance(call.func, ast.Attribute) and call.func.attr == "clear":
            yield Mistake((program.drop(statement),), f"{program.text(call)} is forgotten")


def keeps_the_first_message(program: Program) -> Iterator[Mistake]:
    """A subscription callback keeps the first message instead of the last."""
    began = _beginnings(program)
    for callback in callbacks(program):
        if callback.kind != "subscription" or isinstance(callback.function, ast.Lambda):
            continue
        for statement in program.every(ast.stmt, callback.function):
            unknown, text = None, program.text(statement)
            if isinstance(statement, ast.Assign) and isinstance(statement.value, ast.Constant):
                continue  # the last is as the first
            if isinstance(statement, ast.Assign) and len(statement.targets) == 1:
                target = statement.targets[0]
                name = program.text(target)
                if isinstance(target, ast.Attribute):
                    first = began.get(name)
                    unknown = f"{name} is None" if first is None else f"{name} == {first!r}"
                elif isinstance(target, ast.Subscript) and not isinstance(target.slice, ast.Slice):
                    unknown = f"{program.text(target.slice)} not in {program.text(target.value)}"
                elif name in _names_from_outside(program, callback.function):
                    unknown = f"{name} is None"
            elif isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Call):
                kept = statement.value.func
                if isinstance(kept, ast.Attribute) and kept.attr in ("update", "append"):
                    unknown = f"not {program.text(kept.value)}"
            if unknown:
                edit = program.replace(statement, f"if {unknown}: {text}")
                yield Mistake((edit,), f"{callback.name} keeps the first message: {text}")


def forgets_what_is_old(program: Program) -> Iterator[Mistake]:
    """A kept message counts as none when it is older than 5 s."""
    unknown = [name for name, value in _beginnings(program).items() if value is None]
    every = [callback for callback in callbacks(program) if not isinstance(callback.function, ast.Lambda)]
    for keeping in every:
        for statement in program.every(ast.Assign, keeping.function):
            (target, *_), clock = statement.targets, '__import__("time").monotonic()'
            if keeping.kind != "subscription" or program.text(target) not in unknown:
                continue
            for asking in every:
                function = asking.function
                in_one_class = program.parent(function) is program.parent(keeping.function)
                if (
                    asking.kind in ("service", "goal")
                    and in_one_class
                    and not isinstance(function, ast.Lambda)
                ):
                    name = program.text(target)
                    old = f"{name} is not None and {clock} - {name}_came > {_AGE}"
                    yield Mistake(
                        (
                            program.insert(statement, f"{name}_came = {clock}"),
                            program.insert_first(function.body, f"if {old}: {name} = None"),
                        ),
                        f"{asking.name} takes {name} for unknown when it is older than {_AGE:g} s",
                    )


def _is_blank(value: ast.expr) -> bool:
    is_empty = isinstance(value, ast.List | ast.Tuple) and not value.elts
    is_empty_dict = isinstance(value, ast.Dict) and not value.keys
    return is_empty or is_empty_dict or (isinstance(value, ast.Constant) and not value.value)


def _names_from_outside(program: Program, function: ast.AST) -> set[str]:
    """Return the names that a function declares nonlocal or global."""
    declared = [node for node in ast.walk(function) if isinstance(node, ast.Nonlocal | ast.Global)]
    return {name for node in declared for name in node.names}


def _beginnings(program: Program) -> dict[str, object]:
    """Return the constants that attributes have at first."""
    return {
        program.text(target): value.value
        for target, value, _ in assignments(program)
        if isinstance(value, ast.Constant) and program.function_name(target) == "__init__"
    }
