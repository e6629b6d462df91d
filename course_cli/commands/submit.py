"""`course submit`: write the file of each exercise that a student hands in, and print what it holds."""

from __future__ import annotations

import shutil
import zipfile
from datetime import datetime
from pathlib import Path
from typing import Annotated

import typer
from rich.text import Text

from autograder.engine.exercise import essay_names, file_names
from autograder.engine.submission import Submission, UnusableSubmission, read_submission
from autograder.hand_in_notice import hidden_checks_notice
from autograder.report.console import LineConsole
from course_cli.options import CourseOption
from course_cli.own_work import own_work
from ros_runtime.project import WORK
from ros_runtime.self_checks import last_checks


def submit(
    exercises: Annotated[list[str], typer.Argument(help="the exercises, such as battery_service")],
    file: Annotated[
        Path | None,
        typer.Option(help="your notebook or .py file of one exercise (default: what `check` finds)"),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(help="the folder to write to (default: hand_in/ in the course's folder, or here)"),
    ] = None,
    course: CourseOption = None,
) -> None:
    """Write one file for each exercise to hand in, and print what it holds."""
    console = LineConsole()
    if file and len(exercises) > 1:
        raise typer.BadParameter("--file is the file of one exercise: name that exercise alone")
    out = out or _default_folder()
    for exercise in exercises:
        path, left_aside = own_work(exercise, file)
        submission = read_submission(path, exercise)
        for line in left_aside:
            console.print(f"left aside: {line}", style="yellow", markup=False)
        target = _target(path, exercise, out)
        before = _fingerprint(target, exercise)
        _copy(path, exercise, target)
        console.print(f"{target}: {_contents(submission)}, as saved {_saved(path)}", markup=False)
        console.print(
            f"  fingerprint {submission.fingerprint}: your grade's page shows it again", markup=False
        )
        if before not in ("", submission.fingerprint):
            console.print(
                f"  it replaces another program, fingerprint {before}", style="yellow", markup=False
            )
        console.print("  ", _last_check(submission))
    console.print(f"Next: hand in what is in {out}/, unchanged.", markup=False)


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


def _fingerprint(target: Path, exercise: str) -> str:
    """Return the fingerprint of an earlier file; "" if there is none."""
    try:
        return read_submission(target, exercise).fingerprint if target.exists() else ""
    except UnusableSubmission:
        return ""


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


def _last_check(submission: Submission) -> Text:
    """Return how the last self-check of this program ended, or that there was none."""
    if submission.exercise in essay_names():
        return Text("A person marks it.")
    last = last_checks().get(submission.exercise)
    if last is None or last.program != submission.fingerprint:
        return Text(
            f"This program has not been checked. Next: ./course check {submission.exercise}", "yellow"
        )
    later = hidden_checks_notice(submission.exercise)
    return Text(
        f"Last self-check of this program: {last.passed} of {last.total} visible checks passed. {later}"
    )
