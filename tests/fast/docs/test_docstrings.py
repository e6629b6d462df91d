"""The docstrings have one style: what the linter has no rule for."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
ROOMS = (
    *("autograder", "course_cli", "lab"),
    *("robot_sim", "ros_cli", "ros_runtime", "setup", "solutions", "tests"),
)
# A Sphinx role such as :class:`Name`, or code in double backticks.
OTHER_MARKUP = re.compile(r":\w+:`|``")
DOCUMENTED = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)


def modules() -> Iterator[tuple[str, ast.Module]]:
    """Each of the project's Python files, without the programs that students might have written, and its syntax."""
    for file in sorted(file for room in ROOMS for file in (ROOT / room).rglob("*.py")):
        if "known" not in file.parts:
            yield file.relative_to(ROOT).as_posix(), ast.parse(file.read_text())


def docstrings(module: ast.Module) -> list[str]:
    return [ast.get_docstring(node) or "" for node in ast.walk(module) if isinstance(node, DOCUMENTED)]


def has_annotations(module: ast.Module) -> bool:
    return any(
        isinstance(node, ast.AnnAssign) or getattr(node, "annotation", None) or getattr(node, "returns", None)
        for node in ast.walk(module)
    )


def postpones_annotations(module: ast.Module) -> bool:
    return any(isinstance(node, ast.ImportFrom) and node.module == "__future__" for node in module.body)


def test_code_in_docstrings_has_single_backticks_and_a_file_with_annotations_postpones_them() -> None:
    other_markup, not_postponed = [], []
    for path, module in modules():
        other_markup += [(path, text) for text in docstrings(module) if OTHER_MARKUP.search(text)]
        if has_annotations(module) and not postpones_annotations(module):
            not_postponed.append(path)
    assert (other_markup, not_postponed) == ([], [])
