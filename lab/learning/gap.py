"""A gap in a program of a chapter: the student writes a few lines; `%%gap` saves the file and checks it at once."""

from __future__ import annotations

import pkgutil
from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime
from importlib import import_module
from pathlib import Path
from typing import Any

from IPython.core.getipython import get_ipython
from IPython.core.magic import register_cell_magic

from chapters.support import gaps
from lab.errors import LabError
from lab.learning.gap_cells import MAGIC, is_empty, is_python, placeholder
from lab.learning.progress_file import store_entry
from lab.running.programs import stop_programs
from lab.running.student_nodes import stop_nodes
from ros_runtime.cell_notice import notice


class GapError(LabError):
    """The lines in a gap do not solve the task yet."""


@dataclass(frozen=True)
class Gap:
    """A file with a gap.

    Attributes:
        file: its name, unique in the course.
        check: runs the file and returns a sentence on what it did; raises a LabError if the lines are wrong.
        duration: about how long the check takes, in s; None if it takes less than 5 s.
    """

    file: str
    check: Callable[[], str]
    duration: int | None = None


def expect(condition: object, *, seen: object, expected: str, next: str) -> None:
    """Require a condition.

    Raises GapError if it is false; the message says what was seen, what was expected and what to do next.
    """
    if not condition:
        raise not_yet(seen, expected, next)


def not_yet(seen: object, expected: str, next: str) -> GapError:
    """Return the error for lines that do not solve the task yet."""
    return GapError(f"not yet.\n  seen:     {seen}\n  expected: {expected}\n  next:     {next}")


def read_gaps(chapter: str) -> tuple[Gap, ...]:
    """Return the gaps of a chapter in the order of its cells: `read_gaps("services")`."""
    return import_module(f"chapters.support.gaps.{chapter}").GAPS


def find_gap(file: str) -> Gap:
    """Return the gap of a file.

    Raises LabError when no chapter has a gap in a file of this name.
    """
    known = {
        gap.file: gap for module in pkgutil.iter_modules(gaps.__path__) for gap in read_gaps(module.name)
    }
    if file not in known:
        raise LabError(
            f"%%gap {file}: no chapter has a gap in a file of this name; the files with gaps are {', '.join(known)}"
        )
    return known[file]


def write_and_check(file: str, program: str) -> None:
    """Stop all nodes and programs, save the cell's text to the file, run the gap's check and print the result.

    Raises:
        GapError: the gap is empty, its lines are not Python, or they do not solve the task.
        LabError: the file has no gap, or its program did not run.
    """
    file = file.strip()
    gap = find_gap(file)
    if is_python(file):
        program = f"# {MAGIC}{file}\n{program}"  # a line of the file has the number of the cell's line
    Path(file).write_text(program, encoding="utf-8")
    if is_empty(program):
        raise GapError(
            f"{file}: nothing is written yet. Replace `{placeholder(file)}` by your lines and run this cell again; "
            "click “Solution” below the cell to see a solution"
        )
    if is_python(file):
        _require_python(file, program)
    stop_nodes()
    stop_programs()
    try:
        lasts = f"about {gap.duration} s" if gap.duration else "a few seconds"
        with notice(f"{file} runs, and the check tries what it does: {lasts}, longer on a busy machine."):
            summary = gap.check()
    except GapError as problem:
        raise GapError(f"{file}: {problem}") from None
    finally:
        stop_nodes()
        stop_programs()
    store_entry("gaps", file, datetime.now().isoformat(timespec="seconds"))
    print(f"✓ {file}: {summary}")


def _require_python(file: str, program: str) -> None:
    try:
        compile(program, file, "exec")
    except SyntaxError as problem:
        line = (problem.text or "").strip()
        raise GapError(f"{file}: {problem.msg} in line {problem.lineno}: `{line}`") from None


def _name_syntax_error(result: Any) -> None:
    """Print the syntax error of a program that a `%%writefile` cell has written."""
    head, _, program = (result.info.raw_cell or "").partition("\n")
    magic, _, file = head.partition(" ")
    if magic == "%%writefile" and is_python(file.strip()):
        try:
            _require_python(file.strip(), program)
        except GapError as problem:
            print(f"The file is written, but Python cannot run it. {problem}")


if (shell := get_ipython()) is not None:  # in a notebook
    shell.events.register("post_run_cell", _name_syntax_error)
    register: Any = register_cell_magic("gap")  # Any: IPython declares this type for methods only
    register(write_and_check)
