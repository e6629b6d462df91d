"""A student's work: the file or files of an exercise, or a notebook with cells that write them."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from autograder.engine.exercise import file_names
from autograder.engine.program_text import NoProgram, bytes_of, text_of

MAX_BYTES = 1_000_000  # of a file a student writes
LONGEST_QUOTE = 500  # characters of why a notebook is none, which may quote all of it
MAX_NOTEBOOK_BYTES = 50_000_000  # a notebook also holds pictures of the robot


class UnusableSubmission(Exception):
    """The submission cannot be read; the message says what was found and what is expected."""

    def _render_traceback_(self) -> list[str]:
        """Jupyter shows this instead of a traceback."""
        return [f"{type(self).__name__}: {self}"]


@dataclass(frozen=True)
class Submission:
    """What one student wrote: the text of each file by its name."""

    exercise: str
    student: str
    sources: Mapping[str, str]

    @property
    def files(self) -> dict[str, bytes]:
        """The files to put beside each other when it runs."""
        return {name: bytes_of(name, text) for name, text in self.sources.items()}


def place_of_work(exercise: str, folder: Path) -> Path | None:
    """Return an exercise's program in a folder, or the folder if it has several files; None if there is none."""
    names = file_names(exercise)
    if not any((folder / name).exists() for name in names):
        return None
    return folder / names[0] if len(names) == 1 else folder


def read_submission(path: Path, exercise: str, student: str = "you") -> Submission:
    """Read a notebook, the file itself, or a folder with the files.

    Raises:
        UnusableSubmission: there is nothing that can be read.
    """
    names = file_names(exercise)
    if not path.exists():
        hint = f"; run the cell that begins %%writefile {path.name}" if path.name in names else ""
        raise UnusableSubmission(f"there is no file {path}{hint}")
    if path.suffix == ".ipynb":
        written = sources_from_notebook(_text(path.name, _read(path, MAX_NOTEBOOK_BYTES), path), names, path)
        # %%writefile writes UTF-8, whatever the program declares
        sources = {
            name: _text(name, text.encode(errors="surrogatepass"), path) for name, text in written.items()
        }
    elif path.is_dir():
        there = [name for name in names if (path / name).exists()]
        sources = {name: _text(name, _read(path / name, MAX_BYTES), path / name) for name in there}
    elif len(names) == 1:
        sources = {names[0]: _text(names[0], _read(path, MAX_BYTES), path)}
    else:
        raise UnusableSubmission(
            f"{exercise} has several files, {', '.join(names)}: give the folder they lie in, or the notebook"
        )
    if not sources:
        raise UnusableSubmission(f"{path} holds none of {', '.join(names)}")
    for name, text in sources.items():
        _require_at_most(MAX_BYTES, len(text), name)
    return Submission(exercise, student, sources)


def sources_from_notebook(text: str, names: tuple[str, ...], path: Path) -> dict[str, str]:
    """Return, for each name, the source in the last cell that begins `%%writefile NAME`; the notebook is not run."""
    import nbformat  # which takes a quarter of a second to import, and a program is read without it

    try:
        notebook = nbformat.reads(text, as_version=4)
        cells = [
            source
            for cell in notebook.cells
            if cell.get("cell_type") == "code" and isinstance(source := cell.get("source"), str)
        ]
    except Exception as error:  # a broken file fails in many ways: no JSON, no cells, cells that are none
        raise UnusableSubmission(f"{path} is not a notebook: {str(error)[:LONGEST_QUOTE]}") from error
    found = {
        name: source for name in names for cell in cells if (source := written_by(cell, name)) is not None
    }
    if not found:
        wanted = " or ".join(f"'%%writefile {name}'" for name in names)
        raise UnusableSubmission(f"{path} has no code cell that begins with {wanted}")
    return found


def written_by(cell: str, name: str) -> str | None:
    """Return what a cell writes into the file of that name; None if it does not."""
    magic = re.match(rf"\s*%%writefile\s+(?:\./)?{re.escape(name)}\s*\n", cell)
    return cell[magic.end() :] if magic else None


def _read(path: Path, limit: int) -> bytes:
    try:
        _require_at_most(limit, path.stat().st_size, str(path))
        return path.read_bytes()
    except OSError as error:  # a folder of that name, or nobody may read it
        raise UnusableSubmission(f"{path} cannot be read: {error.strerror}") from error


def _text(name: str, content: bytes, path: Path) -> str:
    try:
        return text_of(name, content)
    except NoProgram as error:
        raise UnusableSubmission(f"{path} {error}") from error


def _require_at_most(limit: int, size: int, what: str) -> None:
    if size > limit:
        raise UnusableSubmission(f"{what} has {size} bytes; at most {limit} are read")
