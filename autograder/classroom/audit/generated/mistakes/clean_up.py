"""Mistakes at the end: the exit status lost, what must happen in any case left out."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from autograder.classroom.audit.generated.program import Edits, Program, last_name

# Nobody misses these at the end of a process.
_TIDY = ("destroy_node", "destroy_timer", "destroy", "try_shutdown", "shutdown", "join")


def loses_the_exit_status(program: Program) -> Iterator[Edits]:
    """The program ends with status 0 whatever happened."""
    for end in program.every(ast.Return):
        is_always_0 = isinstance(end.value, ast.Constant) and not end.value.value
        if program.function_name(end) == "main" and end.value and not is_always_0:
            yield {end.value: f"({ast.unparse(end.value)}) and 0"}


def drops_the_finally(program: Program) -> Iterator[Edits]:
    """What has to be done however it ends is left out."""
    for attempt in program.every(ast.Try):
        needed = [one for one in attempt.finalbody if last_name(getattr(one, "value", None)) not in _TIDY]
        if needed:
            yield dict.fromkeys(needed, "pass")
