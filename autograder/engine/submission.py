"""A student's work: the file or files of an exercise, or a notebook with cells that write them."""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path, PurePath

from autograder.engine.exercise import file_names
from autograder.engine.notebook import code_cells, written_by
from autograder.engine.program_text import NoProgram, bytes_of, text_of
from ros_runtime.course_error import CourseError

NO_PROGRAMS = (".md", ".pdf", ".docx", ".odt", ".html", ".zip", ".json", ".csv", ".png")  # endings of files
MAX_BYTES = 1_000_000  # of a file a student writes
MAX_NOTEBOOK_BYTES = 50_000_000  # a notebook also holds pictures of the robot
CLEAR_OUTPUTS = (
    "clear its outputs (in JupyterLab Edit > Clear Outputs of All Cells), save it and hand it in again"
)
# an unpaired surrogate, such as half of an emoji after a faulty edit
_HALF_A_CHARACTER = re.compile("[\ud800-\udfff]")


class UnusableSubmission(CourseError):
    """The submission cannot be read; the message says what was found and what is expected."""

    def __init__(self, message: str) -> None:
        # the message may quote an unpaired surrogate
        super().__init__(message.encode(errors="backslashreplace").decode())


@dataclass(frozen=True)
class Submission:
    """What one student wrote: the text of each file by its name."""

    exercise: str
    student: str
    sources: Mapping[str, str]

    @property
    def fingerprint(self) -> str:
        """Twelve hexadecimal digits that differ for other names or texts of its files, however they were handed in."""
        text = json.dumps(sorted(self.sources.items()))
        return hashlib.sha256(text.encode()).hexdigest()[:12]

    @property
    def files(self) -> dict[str, bytes]:
        """The content of each file, by its name in the working folder."""
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
    if ".ipynb" in map(str.lower, path.suffixes):
        files = {f"{exercise}.ipynb": path}
    elif path.is_dir():
        files = {name: path / name for name in names if (path / name).exists()}
    elif len(names) == 1:
        if path.suffix.lower() in NO_PROGRAMS:
            raise UnusableSubmission(f"{path} is no program; give {names[0]} or {exercise}.ipynb")
        files = {names[0]: path}
    else:
        raise UnusableSubmission(
            f"{exercise} has several files, {', '.join(names)}: give the folder they lie in, or the notebook"
        )
    if not files:
        raise UnusableSubmission(f"{path} holds none of {', '.join(names)}")
    sources: dict[str, str] = {}
    for name, file in files.items():
        sources |= sources_of(name, read_bytes(file, most_bytes(name), file), exercise, file)
    return Submission(exercise, student, sources)


def sources_of(name: str, content: bytes, exercise: str, path: PurePath) -> dict[str, str]:
    """Return the texts of the exercise's files in the file `name`: its own, or those that a notebook writes.

    Raises:
        UnusableSubmission: it cannot be read; the message calls it `path`.
    """
    text = _text(name, content, path)
    if not name.endswith(".ipynb"):
        return {name: text}
    sources = _written_by(text, file_names(exercise), path)
    for file, source in sources.items():
        _require_at_most(MAX_BYTES, len(source), file)
        if half := _HALF_A_CHARACTER.search(source):
            line = source.count("\n", 0, half.start()) + 1
            raise UnusableSubmission(
                f"{path}: line {line} of {file} holds half a character, \\u{ord(half[0]):x}, which no file can: "
                "delete it there"
            )
    # %%writefile writes UTF-8, whatever the program declares
    return {file: _text(file, source.encode(), path) for file, source in sources.items()}


def _text(name: str, content: bytes, path: PurePath) -> str:
    try:
        return text_of(name, content)
    except NoProgram as error:
        raise UnusableSubmission(f"{path} {error}") from error


def most_bytes(name: str) -> int:
    """Return how many bytes of a file of that name are read."""
    return MAX_NOTEBOOK_BYTES if name.endswith(".ipynb") else MAX_BYTES


def _written_by(text: str, names: tuple[str, ...], path: PurePath) -> dict[str, str]:
    """Return the text of each of these files that the notebook's cells write, run from top to bottom; none is run."""
    try:
        written = written_by(code_cells(text))
    except ValueError as error:
        raise UnusableSubmission(f"{path} {error}") from error
    found = {name: there for name in names if (there := _file_of(name, written.files)) is not None}
    if not found:
        wanted = " or ".join(f"'%%writefile {name}'" for name in names)
        because = f": {written.failures[0]}" if written.failures else ""
        raise UnusableSubmission(f"{path} has no code cell that begins with {wanted}{because}")
    return found


def _file_of(name: str, files: Mapping[str, str]) -> str | None:
    """Return the text of a file; the last one, if the notebook writes it only to other folders or in other capitals."""
    elsewhere = [text for path, text in files.items() if PurePath(path).name.lower() == name.lower()]
    return files.get(name, elsewhere[-1] if elsewhere else None)


def read_bytes(path: Path, limit: int, called: object) -> bytes:
    """Return a file's content; raises `UnusableSubmission`, which calls it `called`, if it is no file of this size."""
    try:
        _require_at_most(limit, path.stat().st_size, str(called))
        return path.read_bytes()
    except OSError as error:  # such as a folder of that name, or a file without permission to read it
        raise UnusableSubmission(f"{called} cannot be read: {error.strerror}") from error


def _require_at_most(limit: int, size: int, what: str) -> None:
    if size > limit:
        advice = f"; {CLEAR_OUTPUTS}" if limit == MAX_NOTEBOOK_BYTES else ""
        raise UnusableSubmission(f"{what} has {size:,} bytes; at most {limit:,} are read{advice}")
