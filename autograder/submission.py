"""A student's work: one Python file, or a notebook with a cell that writes it."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import nbformat

MAX_BYTES = 1_000_000  # of a student's program
MAX_NOTEBOOK_BYTES = 50_000_000  # a notebook also holds pictures of the robot


class UnusableSubmission(Exception):
    """The submission cannot be read; the message says what was found and what is expected."""


@dataclass(frozen=True)
class Submission:
    """The source of `<exercise>.py` by one student."""

    exercise: str
    student: str
    source: str

    @property
    def files(self) -> dict[str, bytes]:
        """The files to put beside each other when it runs."""
        return {f"{self.exercise}.py": self.source.encode()}


def read_submission(path: Path, exercise: str, student: str = "you") -> Submission:
    """Read a .py file or a notebook; raises :class:`UnusableSubmission`."""
    if not path.exists():
        raise UnusableSubmission(f"there is no file {path}")
    is_notebook = path.suffix == ".ipynb"
    _require_at_most(MAX_NOTEBOOK_BYTES if is_notebook else MAX_BYTES, path.stat().st_size, str(path))
    try:
        text = path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        raise UnusableSubmission(f"{path} is not UTF-8 text: {error}") from error
    source = source_from_notebook(text, exercise, path) if is_notebook else text
    _require_at_most(MAX_BYTES, len(source), f"{exercise}.py")
    return Submission(exercise, student, source)


def source_from_notebook(text: str, exercise: str, path: Path) -> str:
    """Return the source in the last cell that begins `%%writefile <exercise>.py`; the notebook is not run."""
    magic = re.compile(rf"\s*%%writefile\s+(?:\./)?{re.escape(exercise)}\.py\s*\n")
    try:
        notebook = nbformat.reads(text, as_version=4)
        found = [
            source[match.end() :]
            for cell in notebook.cells
            if cell.get("cell_type") == "code"
            and isinstance(source := cell.get("source"), str)
            and (match := magic.match(source))
        ]
    except Exception as error:  # a broken file fails in many ways: no JSON, no cells, cells that are none
        raise UnusableSubmission(f"{path} is not a notebook: {error}") from error
    if not found:
        raise UnusableSubmission(f"{path} has no code cell that begins with '%%writefile {exercise}.py'")
    return found[-1]


def _require_at_most(limit: int, size: int, what: str) -> None:
    if size > limit:
        raise UnusableSubmission(f"{what} has {size} bytes; at most {limit} are read")
