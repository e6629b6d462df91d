"""Where a student's program has the callback of a service, which no traceback names once the callback has returned."""

from __future__ import annotations

import ast
import re
from collections.abc import Mapping

_OF_SERVICE = re.compile(
    r"(?<=Your service callback of )(\w+) returned nothing(, or something other than the response)?"
)


def with_callback(help: str, sources: Mapping[str, str]) -> str:
    """Return advice on what a service callback returned, with its function and line; other advice as it is.

    `sources` are the texts of the program's files by name. It parses them: call it in no process that scores others.
    """

    def placed(about: re.Match[str]) -> str:
        for name, text in sources.items():
            if callback := callback_of(about[1], syntax_tree(text)):
                returns = any(isinstance(each, ast.Return) and each.value for each in ast.walk(callback))
                what = (about[2] or "") if returns else ""
                return f"{about[1]}, {callback.name}() in line {callback.lineno} of {name}, returned nothing{what}"
        return about[0]

    return _OF_SERVICE.sub(placed, help)


def callback_of(service: str, tree: ast.Module) -> ast.FunctionDef | ast.AsyncFunctionDef | None:
    """Return the function that a program gives to create_service for a service; None if it is not to be seen."""
    functions = {
        each.name: each for each in ast.walk(tree) if isinstance(each, ast.FunctionDef | ast.AsyncFunctionDef)
    }
    for call in ast.walk(tree):
        if isinstance(call, ast.Call) and ast.unparse(call.func).endswith("create_service"):
            names = [ast.unparse(argument).rpartition(".")[2] for argument in call.args]
            if repr(service) in names and (callback := functions.get(names[-1])):
                return callback
    return None


def syntax_tree(text: str) -> ast.Module:
    """Return the syntax tree of a program; an empty one if Python cannot read it."""
    try:
        return ast.parse(text)
    except (SyntaxError, ValueError, MemoryError, RecursionError):
        return ast.Module(body=[], type_ignores=[])
