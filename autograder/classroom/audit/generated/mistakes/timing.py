"""Mistakes with time: a callback that sleeps, a limit of another size, a deadline that starts at another event."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from autograder.classroom.audit.generated.program import Edits, Program, callbacks, last_name

_SLEEP_TIMES = (0.7, 2.5)  # s
_READS_A_CLOCK = re.compile(r"\b(monotonic|time|_?now|perf_counter)\(")
_CALLS_WITH_SECONDS = {"sleep", "wait", "create_timer", "Duration", "create_rate"}


def waits_in_a_callback(program: Program) -> Iterator[Edits]:
    """A callback sleeps before it does its work."""
    for callback in callbacks(program, "service", "goal", "cancel", "subscription"):
        for seconds in _SLEEP_TIMES:
            yield program.begun_with(callback, f"__import__('time').sleep({seconds})")


def halves_or_doubles(program: Program) -> Iterator[Edits]:
    """A limit, a deadline or a count is half or double what it should be."""
    for constant in program.every(ast.Constant):
        number = constant.value
        if isinstance(number, bool) or not isinstance(number, int | float) or not number:
            continue
        if _is_a_limit(program, constant):
            yield {constant: repr(number // 2 if isinstance(number, int) else number / 2)}
            yield {constant: repr(number * 2)}


def restarts_the_deadline(program: Program) -> Iterator[Edits]:
    """A deadline is not restarted at its event, or is restarted at another event."""
    for statement in program.every(ast.Assign):
        target, text, around = statement.targets[0], ast.unparse(statement), program.functions(statement)
        if not _READS_A_CLOCK.search(text) or not around or last_name(target) == "stamp":
            continue
        if isinstance(target, ast.Name):
            for loop in program.every(ast.While, around[0]):
                if loop.lineno > statement.lineno and target.id in _names(loop):
                    yield {loop.body[0]: f"{text}\n{ast.unparse(loop.body[0])}"}
            continue
        if program.function_name(statement) != "__init__":
            yield {statement: "pass"}
        is_of_self_alone = all(re.fullmatch("self|time|[A-Z_]+", name) for name in _names(statement))
        for callback in callbacks(program, "subscription", "feedback", "timer") if is_of_self_alone else ():
            if program.parent(callback) is program.parent(around[0]):
                yield program.begun_with(callback, text)


def _is_a_limit(program: Program, constant: ast.Constant) -> bool:
    """Whether a number is a constant of the module, an operand of a comparison, or a time to wait."""
    parent, *above = program.above(constant)
    if isinstance(parent, ast.keyword):  # spin_once is called in a loop, so its timeout limits nothing
        return parent.arg in ("timeout_sec", "seconds") and last_name(above[0]) != "spin_once"
    if isinstance(parent, ast.Call):
        return last_name(parent) in _CALLS_WITH_SECONDS and constant in parent.args[:1]
    in_module = isinstance(parent, ast.Assign) and not program.functions(parent)
    return isinstance(parent, ast.Compare) or in_module


def _names(node: ast.AST) -> set[str]:
    return {name.id for name in ast.walk(node) if isinstance(name, ast.Name)}
