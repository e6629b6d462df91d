"""`course submit`: write the file of each exercise that a student hands in, and print what it holds."""

from __future__ import annotations

import os
import shutil
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import datetime
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Annotated

import typer

from autograder.engine.exercise import essay_names, file_names
from autograder.engine.submission import Submission, UnusableSubmission, read_submission
from autograder.hand_in_notice import hidden_checks_notice
from autograder.report.console import NOTICE, LineConsole
from course_cli.options import CourseOption
from course_cli.own_work import own_work
from course_cli.reasons_not_to_submit import (
    flaw_of,
    in_words,
    is_better,
    last_check,
    syntax_error,
    unsaved_program,
)
from ros_runtime.course_error import COMMAND_FAILED
from ros_runtime.project import WORK
from ros_runtime.self_checks import FILE, store_submitted, was_submitted
from ros_runtime.terminal import as_typed


def submit(
    exercises: Annotated[
        list[str], typer.Argument(metavar="EXERCISE", help="one or more, such as battery_service")
    ],
    file: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE", help="your notebook or .py file of one exercise (default: what `check` finds)"
        ),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="FOLDER",
            help="where to write (default: hand_in/ in the course's folder, or here)",
            file_okay=False,
        ),
    ] = None,
    course: CourseOption = None,
) -> None:
    """Write one file for each exercise to hand in, and print what it holds.

    It replaces the file that an earlier `submit` wrote for the exercise, unless that program has passed more visible
    checks. A starter in which nothing is filled in is not handed in.
    """
    console = LineConsole()
    if file and len(exercises) > 1:
        raise typer.BadParameter("--file is the file of one exercise: name that exercise alone")
    out = out or _default_folder()
    left = _LeftToDo()
    for exercise in exercises:
        path, left_aside = own_work(exercise, file, "submit {} --file FILE")
        if out.resolve() == (path if path.is_dir() else path.parent).resolve():
            raise typer.BadParameter(f"{out} holds your own {path.name}: give another folder as --out")
        submission = read_submission(path, exercise)
        unsaved = unsaved_program(path, submission)
        for line in left_aside:
            if not (unsaved and line.startswith(f"{unsaved} ")):  # which is said below
                console.print(f"left aside: {line}", style=NOTICE, markup=False)
        earlier = _earlier(exercise, out)
        if flaw := flaw_of(path, submission):
            left.unfinished.append(exercise)
            console.print(flaw, style=NOTICE, markup=False)
        better = {
            old: work for old, work in earlier.items() if work and is_better(old, work, submission, flaw)
        }
        for old, work in better.items():
            left.worse += [] if flaw else [old]
            now = "" if flaw else f"; this program: {last_check(submission) or 'not checked yet'}"
            console.print(
                f"{path.name} is not handed in; {old} is not replaced: it keeps {in_words(work)}{now}",
                style=NOTICE,
                markup=False,
            )
        if better or (flaw and not syntax_error(submission)):
            continue
        _write(console, path, submission, out, earlier, left)
        if unsaved:
            left.unsaved.append(exercise)
            console.print(
                f"  Not handed in: {unsaved}, the program of the cell that you ran last; {path.name} is saved "
                "without it.",
                style=NOTICE,
                markup=False,
            )
    console.print(left.next_step(out), markup=False)
    if left.unfinished or left.worse:
        raise typer.Exit(COMMAND_FAILED)


@dataclass
class _LeftToDo:
    """Exercises, and files in the folder to hand in, with which something is still to be done.

    Attributes:
        unfinished: exercises whose program is the starter, or one that Python cannot run.
        unsaved: exercises whose notebook is saved without the program that its cell wrote last.
        unchecked: exercises whose program has not been checked.
        worse: files whose program has passed more visible checks than the one that would replace it.
        foreign: files that `submit` did not write.
    """

    unfinished: list[str] = field(default_factory=list)
    unsaved: list[str] = field(default_factory=list)
    unchecked: list[str] = field(default_factory=list)
    worse: list[Path] = field(default_factory=list)
    foreign: list[Path] = field(default_factory=list)

    def next_step(self, out: Path) -> str:
        """Return what to do next."""
        if self.unfinished or self.unsaved:
            again = as_typed(" ".join(["submit", *self.unfinished, *self.unsaved]))
            complete = "write or mend the program, " if self.unfinished else ""
            return f"Next: {complete}save it (Ctrl+S), and type again: {again}"
        if self.worse:
            files = " and ".join(map(str, self.worse))
            check = " and ".join(as_typed(f"check {path.stem}") for path in self.worse)
            return (
                f"Next: {check}, and submit again once it passes as many; to hand it in all the same, "
                f"remove {files}."
            )
        first = [f"{as_typed(f'check {exercise}')}; " for exercise in self.unchecked]
        first += [f"remove {path} unless it is what you mean to hand in; " for path in self.foreign]
        place = f"the folder {out.name} beside exercises" if ".." in out.parts else f"{out}/"
        return f"Next: {'then '.join([*first, ''])}hand in what is in {place}, unchanged."


def _write(
    console: LineConsole,
    path: Path,
    submission: Submission,
    out: Path,
    earlier: Mapping[Path, Submission | None],
    left: _LeftToDo,
) -> None:
    """Write the file of an exercise in place of earlier ones, and print what it holds and what it replaces."""
    exercise = submission.exercise
    target = _target(path, exercise, out)
    _copy(path, exercise, target)
    console.print(
        f"{target}: {_contents(submission)}, as saved {_saved(path)} (later edits are not in it: save them with "
        "Ctrl+S, and submit again)",
        markup=False,
    )
    console.print(f"  fingerprint {submission.fingerprint}: your grade's page shows it again", markup=False)
    for old, before in earlier.items():
        if old != target and not was_submitted(old, FILE):
            left.foreign.append(old)
            console.print(f"  {old} stays: submit did not write it", style=NOTICE, markup=False)
            continue
        if old != target:
            old.unlink()
        if said := _replaced(old, before, target, submission):
            console.print(f"  it replaces {said}", style=NOTICE, markup=False)
    store_submitted(target, FILE)
    if exercise in essay_names():
        console.print("  A person marks it.")
    elif checked := last_check(submission):
        console.print(f"  Last self-check of this program: {checked}. {hidden_checks_notice(exercise)}")
    elif exercise in left.unfinished:
        console.print("  It gets no points as it is.", style=NOTICE)
    else:
        left.unchecked.append(exercise)
        console.print("  This program has not been checked.", style=NOTICE)


def _default_folder() -> Path:
    """Return hand_in/ at the top of the student's course, also for a cell, which runs in its notebook's folder."""
    here = Path.cwd()
    course = WORK.resolve()
    return Path(os.path.relpath(course if here.is_relative_to(course) else here)) / "hand_in"


def _earlier(exercise: str, out: Path) -> dict[Path, Submission | None]:
    """Return what the files in a folder hold that may be handed in for an exercise; None for one that is unreadable."""
    names = file_names(exercise)
    others = names[0] if len(names) == 1 else f"{exercise}.zip"
    paths = [path for name in (f"{exercise}.ipynb", others) if (path := out / name).is_file()]
    return {path: _work_in(path, exercise) for path in paths}


def _work_in(path: Path, exercise: str) -> Submission | None:
    """Return what a file for handing in holds; None if it cannot be read."""
    try:
        if path.suffix != ".zip":
            return read_submission(path, exercise)
        with zipfile.ZipFile(path) as archive, TemporaryDirectory() as folder:
            for name in file_names(exercise):
                if name in archive.namelist():
                    archive.extract(name, folder)
            return read_submission(Path(folder), exercise)
    except (UnusableSubmission, zipfile.BadZipFile):
        return None


def _replaced(old: Path, work: Submission | None, target: Path, new: Submission) -> str:
    """Return in words what is replaced; "" if it is the same program in a file of the same name."""
    words = "a file that cannot be read"
    if work:
        is_same = work.fingerprint == new.fingerprint
        words = "the same program" if is_same else f"another program, {in_words(work)}"
        if is_same and old == target:
            return ""
    return words if old == target else f"{old.name}: {words}"


def _target(path: Path, exercise: str, out: Path) -> Path:
    """Return the file to write: under the name that the grader looks for, or a zip file for several files."""
    if path.is_dir():
        return out / f"{exercise}.zip"
    is_notebook = ".ipynb" in map(str.lower, path.suffixes)
    return out / (f"{exercise}.ipynb" if is_notebook else file_names(exercise)[0])


def _copy(path: Path, exercise: str, target: Path) -> None:
    """Copy a file, or zip a folder of several files."""
    target.parent.mkdir(parents=True, exist_ok=True)
    if path.is_dir():
        with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED, strict_timestamps=False) as archive:
            for name in file_names(exercise):
                if (path / name).exists():
                    archive.write(path / name, name)
    else:
        shutil.copyfile(path, target)


def _contents(submission: Submission) -> str:
    lines = {name: len(text.splitlines()) for name, text in submission.sources.items()}
    return "; ".join(f"{name}, {number} line{'' if number == 1 else 's'}" for name, number in lines.items())


def _saved(path: Path) -> str:
    files = [*path.iterdir()] if path.is_dir() else [path]
    newest = max(file.stat().st_mtime for file in files)
    return datetime.fromtimestamp(newest).strftime("%Y-%m-%d %H:%M:%S")
