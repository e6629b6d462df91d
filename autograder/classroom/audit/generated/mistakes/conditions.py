"""Mistakes with conditions: forgotten, turned round, for another state."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from autograder.classroom.audit.generated.program import Edits, Program

_LEAVING = (ast.Return, ast.Raise, ast.Continue, ast.Break)


def takes_another_constant(program: Program) -> Iterator[Edits]:
    """A state is compared with the wrong constant, or a code is another one."""
    for constant in program.every(ast.Attribute):
        for other in program.interfaces.other_constants(constant.attr):
            yield {constant: f"{ast.unparse(constant.value)}.{other}"}


def drops_a_guard(program: Program) -> Iterator[Edits]:
    """A case is not looked at, or a guard lets through what it should refuse."""
    for case in program.every(ast.If):
        if program.functions(case):
            yield {case.test: "False"}
            if isinstance(case.body[-1], _LEAVING) and not case.orelse:
                yield {case.test: f"not ({ast.unparse(case.test)})"}
