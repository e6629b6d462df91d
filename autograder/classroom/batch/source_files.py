"""Writes sources/: each graded program, in the layout of plagiarism detectors (JPlag, MOSS, Dolos).

    sources/<exercise>/<student>/<exercise>.py   the student's program, without other cells of the notebook
    sources/_base/<exercise>/<exercise>.py       the starter code of that program, which the tools should ignore

The starter code is not in an exercise's folder, because a student could be called _base.
"""

from __future__ import annotations

import shutil
from collections.abc import Mapping
from pathlib import Path

from autograder.atomic_file import write_atomically
from autograder.classroom.batch.runner import Graded
from autograder.engine.submission import UnusableSubmission, read_submission

SOURCES, BASE = "sources", "_base"


def write_source(out: Path, result: Graded) -> None:
    """Write the program of a result; remove the earlier files of a submission that cannot be read."""
    _replace(out / SOURCES / result.work.exercise / result.work.student, result.sources or {})


def graded_sources(out: Path, exercise: str, student: str) -> dict[str, str] | None:
    """Return the program that `write_source` has written; None if the submission could not be read."""
    files = sorted((out / SOURCES / exercise / student).glob("*"))
    return {file.name: file.read_text(encoding="utf-8") for file in files} or None


def write_base_code(out: Path, exercise: str, releases: Path) -> None:
    """Write the starter code from the notebook in releases/<exercise>/, if there is one."""
    try:
        given = read_submission(releases / exercise / f"{exercise}.ipynb", exercise).sources
    except UnusableSubmission:
        return
    _replace(out / SOURCES / BASE / exercise, given)


def _replace(folder: Path, files: Mapping[str, str]) -> None:
    kept = {name: text for name, text in files.items() if Path(name).name == name}
    if not kept:
        shutil.rmtree(folder, ignore_errors=True)
        return
    for path in folder.iterdir() if folder.is_dir() else ():
        if path.name not in kept:
            path.unlink()
    for name, text in kept.items():
        write_atomically(folder / name, text)
