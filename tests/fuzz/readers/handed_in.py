"""Submissions: notebooks, programs, and folders with anything that an archive can contain."""

from __future__ import annotations

import json
import os
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import nbformat
from hypothesis import strategies as st

from autograder.classroom.batch.collection import NoSubmissions, collect
from autograder.classroom.nbgrader_bridge.generated_cells import cell_metadata
from autograder.classroom.nbgrader_bridge.rebuild_submission import rebuild_submission
from autograder.classroom.questions.formgrader import LONGEST_ANSWER, answers_in
from autograder.engine.exercise import file_names
from autograder.engine.submission import MAX_BYTES, UnusableSubmission, read_submission
from fuzz import strategies as odd
from fuzz.fuzzer import Fuzzer
from ros_runtime.project import PROJECT

SECRET = "the instructor's own"  # stands in files outside the student's folder
OTHERS = "another student's"
LONGEST_REASON = 2000  # characters of why something cannot be read
EXERCISE = "battery_service"


class Entry(NamedTuple):
    """An entry in a student's folder: its path, its kind, and its content or target."""

    place: str
    kind: str
    content: bytes


def require_submission_or_reason(data: bytes) -> None:
    """Require that a notebook of these bytes is read within bounds, or refused with a reason."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, f"{EXERCISE}.ipynb")
        path.write_bytes(data)
        try:
            submission = read_submission(path, EXERCISE)
        except UnusableSubmission as error:
            assert len(str(error)) <= LONGEST_REASON, "a reason is short"
            return
    assert set(submission.sources) == {f"{EXERCISE}.py"}
    assert all(len(text) <= MAX_BYTES for text in submission.sources.values())


def require_own_work(entries: list[Entry]) -> None:
    """Require that a class with such a folder is collected, and that no student gets another's work."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name).resolve()
        secret, submitted = folder / "secret", folder / "submitted"
        for place, text in ((secret, SECRET), (submitted / "zoe" / EXERCISE, OTHERS)):
            place.mkdir(parents=True)
            for file in (f"{EXERCISE}.py", "GetBatteryStatus.srv", "timestamp.txt"):
                (place / file).write_text(f"# {text}\n")
            (place / "submission_secret.txt").write_text("0f" * 64)
        (submitted / "anna").mkdir()
        for entry in entries:
            _make(submitted / "anna", entry, secret)
        try:
            works = collect(submitted).works
        except NoSubmissions:
            raise AssertionError("zoe's work was not found") from None
        read = {}
        for work in works:
            try:
                read[work.student, work.exercise] = "".join(work.read().sources.values())
            except UnusableSubmission as error:
                assert str(folder) not in str(error), "a student reads where the instructor's folders are"
                assert len(str(error)) <= LONGEST_REASON, "a reason is short"
        assert OTHERS in read.pop(("zoe", EXERCISE), ""), "a sound submission was lost"
        assert not any(work.secret for work in works if work.student == "anna"), "another's secret was taken"
        for text in read.values():
            assert SECRET not in text, "a file from outside the class was read"
            assert OTHERS not in text, "the file of another student was read"
            text.encode()


def require_answers_or_reason(entries: list[Entry]) -> None:
    """Require that the answers to an examiner's questions are read within bounds and are the student's own."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name).resolve()
        for place, text in ((folder / "secret", SECRET), (folder / "submitted" / "zoe", OTHERS)):
            (place / EXERCISE).mkdir(parents=True)
            (place / EXERCISE / f"{EXERCISE}.ipynb").write_text(json.dumps(_answered(text)))
        for entry in entries:
            _make(folder / "submitted" / "anna", entry, folder / "secret" / EXERCISE)
        try:
            answers = answers_in(folder / "submitted" / "anna", EXERCISE)
        except (UnusableSubmission, ValueError) as error:
            assert str(folder) not in str(error), "a student reads where the instructor's folders are"
            return
    for text in answers.values():
        assert len(text) <= LONGEST_ANSWER
        assert SECRET not in text, "a file from outside the class was read"
        assert OTHERS not in text, "the file of another student was read"
        text.encode()


def require_rebuilt(source: str) -> None:
    """Require that nbgrader gets a valid notebook, whatever the source is, and of bounded length."""
    rebuilt = rebuild_submission(_RELEASE, file_names(EXERCISE), {f"{EXERCISE}.py": source})
    assert len(nbformat.writes(rebuilt)) < 2_000_000


def _make(home: Path, entry: Entry, secret: Path) -> None:
    """Create an entry if the file system allows it; replaces nothing."""
    path = home / entry.place
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        if not path.parent.resolve().is_relative_to(home):
            return  # through a link; no download is unpacked so
        _MAKERS[entry.kind](path, entry.content, secret)
    except (OSError, ValueError):  # no name for a file, or there is something already
        return


def _sparse(path: Path, content: bytes, secret: Path) -> None:
    with path.open("xb") as file:
        file.truncate(60_000_000)


def _written(path: Path, content: bytes, secret: Path) -> None:
    with path.open("xb") as file:
        file.write(content)


def _closed(path: Path, content: bytes, secret: Path) -> None:
    _written(path, content, secret)
    path.chmod(0)


_MAKERS: dict[str, Callable[[Path, bytes, Path], Any]] = {
    "file": _written,
    "closed file": _closed,
    "sparse file": _sparse,
    "folder": lambda path, content, secret: path.mkdir(),
    "pipe": lambda path, content, secret: os.mkfifo(path),
    "link to a secret folder": lambda path, content, secret: path.symlink_to(secret),
    "link to a secret file": lambda path, content, secret: path.symlink_to(secret / f"{EXERCISE}.py"),
    "link to another's folder": lambda path, content, secret: path.symlink_to(
        secret.parent / "submitted" / "zoe" / EXERCISE
    ),
    "link to itself": lambda path, content, secret: path.symlink_to(path),
    "link to nothing": lambda path, content, secret: path.symlink_to("/nowhere"),
    "link to a device": lambda path, content, secret: path.symlink_to("/dev/zero"),
}

_RELEASE = nbformat.read(PROJECT / f"exercises/{EXERCISE}/{EXERCISE}.ipynb", as_version=4)
_CELLS = [
    nbformat.v4.new_markdown_cell("read this"),
    nbformat.v4.new_code_cell(f"%%writefile {EXERCISE}.py\nprint('work')\n"),
    nbformat.v4.new_code_cell("1 + 1", outputs=[nbformat.v4.new_output("stream", name="stdout", text="2")]),
]
_SMALL = json.loads(nbformat.writes(nbformat.v4.new_notebook(cells=_CELLS)))


def _answered(text: str) -> Any:
    """Return a notebook with an answer."""
    cell = nbformat.v4.new_markdown_cell(text, metadata=cell_metadata("question_1", points=2, solution=True))
    return json.loads(nbformat.writes(nbformat.v4.new_notebook(cells=[cell])))


_damaged_answers = odd.damaged_json([_answered("own")]).map(lambda value: json.dumps(value).encode())
_damaged_notebooks = odd.damaged_json([_SMALL]).map(lambda value: json.dumps(value).encode())
_notebooks = st.one_of(_damaged_notebooks, odd.mutated([json.dumps(_SMALL).encode()]), odd.blobs)
_places = st.sampled_from(
    (
        *(f"{EXERCISE}.py", f"{EXERCISE}.ipynb", "walk_to.py", "arm_architecture/design.txt"),
        EXERCISE,
        *(f"{EXERCISE}/{name}" for name in (f"{EXERCISE}.py", f"{EXERCISE}.ipynb", "timestamp.txt")),
        *(f"{EXERCISE}/submission_secret.txt", "interfaces", "interfaces/GetBatteryStatus.srv"),
        *("interfaces/interfaces.ipynb", "a/" * 200 + "deep.py", "x" * 255, "\udcff.py", "-rf", "\n"),
    )
)
_answers = st.builds(
    Entry,
    st.sampled_from((f"{EXERCISE}.ipynb", EXERCISE, f"{EXERCISE}/{EXERCISE}.ipynb")),
    st.sampled_from(sorted(_MAKERS)),
    st.one_of(odd.blobs, _damaged_answers),
)
_entries = st.builds(Entry, _places, st.sampled_from(sorted(_MAKERS)), st.one_of(odd.blobs, _notebooks))

FUZZERS = (
    Fuzzer("files-notebook", "files", _notebooks, require_submission_or_reason),
    Fuzzer("files-folder", "files", st.lists(_entries, min_size=1, max_size=5), require_own_work, weight=0.7),
    Fuzzer("files-answers", "files", st.lists(_answers, min_size=1, max_size=3), require_answers_or_reason),
    Fuzzer("files-rebuilt", "files", odd.texts, require_rebuilt, weight=0.3),
)
