"""`course submit`: write the file of each exercise that a student hands in, and print what it holds."""

from __future__ import annotations

import shutil
import warnings
import zipfile
from datetime import datetime
from pathlib import Path
from typing import Annotated

import typer

from autograder.engine.exercise import essay_names, file_names
from autograder.engine.submission import Submission, UnusableSubmission, read_submission
from autograder.hand_in_notice import hidden_checks_notice
from autograder.report.console import NOTICE, LineConsole
from course_cli.options import CourseOption
from course_cli.own_work import own_work
from ros_runtime.course_error import COMMAND_FAILED
from ros_runtime.project import WORK
from ros_runtime.self_checks import last_checks


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
            metavar="FOLDER", help="where to write (default: hand_in/ in the course's folder, or here)"
        ),
    ] = None,
    course: CourseOption = None,
) -> None:
    """Write one file for each exercise to hand in, and print what it holds.

    If Python cannot run a program, an earlier file with a program that it can run stays.
    """
    console = LineConsole()
    if file and len(exercises) > 1:
        raise typer.BadParameter("--file is the file of one exercise: name that exercise alone")
    out = out or _default_folder()
    broken: list[str] = []
    unchecked: list[str] = []
    for exercise in exercises:
        path, left_aside = own_work(exercise, file)
        submission = read_submission(path, exercise)
        for line in left_aside:
            console.print(f"left aside: {line}", style=NOTICE, markup=False)
        target = _target(path, exercise, out)
        before = _earlier(target, exercise)
        if error := _syntax_error(submission):
            broken.append(exercise)
            console.print(f"Python cannot run {path}: {error}", style=NOTICE, markup=False)
            if before and not _syntax_error(before):
                console.print(f"  {target} is not replaced: it keeps {_in_words(before)}", markup=False)
                continue
        _copy(path, exercise, target)
        console.print(f"{target}: {_contents(submission)}, as saved {_saved(path)}", markup=False)
        console.print(
            f"  fingerprint {submission.fingerprint}: your grade's page shows it again", markup=False
        )
        if before and before.fingerprint != submission.fingerprint:
            console.print(f"  it replaces another program, {_in_words(before)}", style=NOTICE, markup=False)
        if exercise in essay_names():
            console.print("  A person marks it.")
        elif checked := _last_check(submission):
            console.print(f"  Last self-check of this program: {checked}. {hidden_checks_notice(exercise)}")
        elif not error:
            unchecked.append(exercise)
            console.print("  This program has not been checked.", style=NOTICE)
    console.print(_next_step(broken, unchecked, out), markup=False)
    if broken:
        raise typer.Exit(COMMAND_FAILED)


def _next_step(broken: list[str], unchecked: list[str], out: Path) -> str:
    """Return what to do, by the exercises whose program Python cannot run, and those that were not checked."""
    if broken:
        return f"Next: correct the program, save it, and type again: ./course submit {' '.join(broken)}"
    first = "".join(f"./course check {exercise}; then " for exercise in unchecked)
    return f"Next: {first}hand in what is in {out}/, unchanged."


def _default_folder() -> Path:
    """Return hand_in/ at the top of the student's course, also for a cell, which runs in its notebook's folder."""
    here = Path.cwd()
    return (WORK if here.is_relative_to(WORK.resolve()) else here) / "hand_in"


def _target(path: Path, exercise: str, out: Path) -> Path:
    """Return the file to write: under the name that the grader looks for, or a zip file for several files."""
    if path.is_dir():
        return out / f"{exercise}.zip"
    is_notebook = ".ipynb" in map(str.lower, path.suffixes)
    return out / (f"{exercise}.ipynb" if is_notebook else file_names(exercise)[0])


def _earlier(target: Path, exercise: str) -> Submission | None:
    """Return what an earlier file holds; None if there is none that can be read."""
    try:
        return read_submission(target, exercise) if target.exists() else None
    except UnusableSubmission:
        return None


def _syntax_error(submission: Submission) -> str:
    """Return why Python cannot run a program, and in which line; "" if it can."""
    for name, text in submission.sources.items():
        try:
            if name.endswith(".py"):
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore")
                    compile(text, name, "exec", dont_inherit=True)
        except SyntaxError as error:
            return f"line {error.lineno} of {name}: {error.msg}"
        except (MemoryError, RecursionError):
            return f"an expression in {name} is nested too deeply"
    return ""


def _in_words(submission: Submission) -> str:
    """Return a program's fingerprint and, if it was the last one that was checked, how the check ended."""
    checked = _last_check(submission)
    return f"fingerprint {submission.fingerprint}" + (f": {checked}" if checked else "")


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
    return "; ".join(f"{name}, lines: {len(text.splitlines())}" for name, text in submission.sources.items())


def _saved(path: Path) -> str:
    files = [*path.iterdir()] if path.is_dir() else [path]
    newest = max(file.stat().st_mtime for file in files)
    return datetime.fromtimestamp(newest).strftime("%Y-%m-%d %H:%M:%S")


def _last_check(submission: Submission) -> str:
    """Return how the last self-check of this program ended; "" if there was none, or of a later program."""
    last = last_checks().get(submission.exercise)
    if last is None or last.program != submission.fingerprint:
        return ""
    return f"{last.passed} of {last.total} visible checks passed"
