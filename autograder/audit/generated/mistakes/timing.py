"""Mistakes with time: waits where none may be, constants of another size, deadlines that begin at another event."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from autograder.audit.generated.callbacks import callbacks
from autograder.audit.generated.program import Mistake, Program, last_name

_WAITS = (0.7, 2.5)  # s
_WAITING = ("service", "goal", "cancel", "subscription")
_CLOCKS = {"monotonic", "time", "now", "_now", "perf_counter"}
_TAKING_SECONDS = {"sleep", "wait", "create_timer", "Duration", "create_rate"}


def waits_in_a_callback(program: Program) -> Iterator[Mistake]:
    """A callback sleeps before it does its work."""
    for callback in callbacks(program):
        for seconds in _WAITS if callback.kind in _WAITING else ():
            wait = f'__import__("time").sleep({seconds})'
            if isinstance(callback.function, ast.Lambda):
                body = callback.function.body
                edit = program.replace(body, f"{wait} or {program.text(body)}")
            else:
                edit = program.insert_first(callback.function.body, wait)
            yield Mistake((edit,), f"time.sleep({seconds}) at the start of {callback.name}")


def halves_or_doubles(program: Program) -> Iterator[Mistake]:
    """A limit, a deadline or a number of things is half or double what it should be."""
    for constant in program.every(ast.Constant):
        value = constant.value
        if isinstance(value, bool) or not isinstance(value, int | float) or not value:
            continue
        if _is_a_limit(program, constant):
            for wrong in (value // 2 if isinstance(value, int) else value / 2, value * 2):
                sentence = f"{wrong} instead of {value} in {program.text(program.statement(constant)).splitlines()[0]}"
                yield Mistake((program.replace(constant, repr(wrong)),), sentence)


def restarts_the_deadline(program: Program) -> Iterator[Mistake]:
    """A deadline is not begun anew at its event, or begins anew at one that does not count."""
    for statement in program.every(ast.Assign):
        target = statement.targets[0]
        is_deadline = _reads_a_clock(statement.value) and last_name(target) != "stamp"
        if not program.functions(statement) or not is_deadline:
            continue
        name, text = program.text(target), program.text(statement)
        if isinstance(target, ast.Name):
            for loop in _loops_after(program, statement, target.id):
                edit = program.insert_first(loop.body, text)
                yield Mistake((edit,), f"{name} begins anew in every round of the loop")
        elif program.function_name(statement) != "__init__":
            yield Mistake((program.drop(statement),), f"{name} does not begin anew")
        for callback in callbacks(program):
            function = callback.function
            if isinstance(function, ast.Lambda) or not _knows(program, function, statement):
                continue
            if callback.kind in ("subscription", "feedback", "timer") and text not in program.text(function):
                yield Mistake(
                    (program.insert_first(function.body, text),), f"{name} begins anew in {callback.name}"
                )


def _is_a_limit(program: Program, constant: ast.Constant) -> bool:
    """Whether a number is a constant of the module, one to compare with, or a time to wait."""
    above = list(program.above(constant))
    keyword = above[0].arg if isinstance(above[0], ast.keyword) else ""
    if keyword in ("timeout_sec", "seconds"):
        return last_name(above[1]) != "spin_once"  # which is called again and again
    if isinstance(above[0], ast.Call):
        return last_name(above[0]) in _TAKING_SECONDS and constant in above[0].args[:1]
    if isinstance(above[0], ast.Compare):
        return True
    in_module = isinstance(above[-2] if len(above) > 1 else None, ast.Assign)
    return in_module and not any(isinstance(one, ast.Call) for one in above)


def _reads_a_clock(value: ast.expr) -> bool:
    return any(isinstance(node, ast.Call) and last_name(node) in _CLOCKS for node in ast.walk(value))


def _loops_after(program: Program, statement: ast.stmt, name: str) -> Iterator[ast.While | ast.For]:
    """Yield the loops that come after a statement in its block, and read a name."""
    for _, block in ast.iter_fields(program.parent(statement)):
        if not isinstance(block, list) or statement not in block:
            continue
        for later in block[block.index(statement) + 1 :]:
            names = {node.id for node in ast.walk(later) if isinstance(node, ast.Name)}
            if isinstance(later, ast.While | ast.For) and name in names:
                yield later


def _knows(program: Program, function: ast.AST, statement: ast.Assign) -> bool:
    """Whether a method can do what a statement of another method of its class does: it speaks of self alone."""
    own = program.functions(statement)[0]
    local = {
        node.id for node in ast.walk(own) if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)
    }
    local |= {parameter.arg for parameter in own.args.args} - {"self"}
    names = {node.id for node in ast.walk(statement) if isinstance(node, ast.Name)}
    return program.parent(own) is program.parent(function) and own is not function and not names & local
