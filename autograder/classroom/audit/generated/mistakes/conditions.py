"""Mistakes of control flow: conditions left out or negated, the exit status lost, the `finally` block left out."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from autograder.classroom.audit.generated.program import Edits, Program, last_name

_JUMPS = (ast.Return, ast.Raise, ast.Continue, ast.Break)
# Calls that have no effect at the end of a process, so that leaving them out is not a mistake.
_CLEANUP_CALLS = ("destroy_node", "destroy_timer", "destroy", "try_shutdown", "shutdown", "join")


def takes_another_constant(program: Program) -> Iterator[Edits]:
    """A comparison or an assignment uses the wrong constant."""
    for constant in program.every(ast.Attribute):
        for other in program.interfaces.other_constants(constant.attr):
            yield {constant: f"{ast.unparse(constant.value)}.{other}"}


def drops_a_guard(program: Program) -> Iterator[Edits]:
    """A case is not handled, or a guard accepts what it should reject."""
    for case in program.every(ast.If):
        if program.functions(case):
            yield {case.test: "False"}
            if isinstance(case.body[-1], _JUMPS) and not case.orelse:
                yield {case.test: f"not ({ast.unparse(case.test)})"}


def loses_the_exit_status(program: Program) -> Iterator[Edits]:
    """The program always ends with status 0."""
    for end in program.every(ast.Return):
        is_always_0 = isinstance(end.value, ast.Constant) and not end.value.value
        if program.function_name(end) == "main" and end.value and not is_always_0:
            yield {end.value: f"({ast.unparse(end.value)}) and 0"}


def drops_the_finally(program: Program) -> Iterator[Edits]:
    """The code that must run in any case, in `finally`, is left out."""
    for attempt in program.every(ast.Try):
        needed = [
            one for one in attempt.finalbody if last_name(getattr(one, "value", None)) not in _CLEANUP_CALLS
        ]
        if needed:
            yield dict.fromkeys(needed, "pass")
