"""`course questions`: makes short questions for each student about their own program and its run, with keys."""

from __future__ import annotations

import os
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from autograder.classroom.batch.collection import Work, collect
from autograder.classroom.batch.version import checks_version
from autograder.classroom.nbgrader_bridge.course_folder import NbgraderError
from autograder.classroom.questions.formgrader import assignment_of, enter_questions
from autograder.classroom.questions.making import Maker
from autograder.classroom.questions.pages import EXAMINER, STUDENTS, TABLE, write_pages
from autograder.classroom.questions.question import Sheet, keep, kept
from autograder.engine.exercise import Exercise, load_exercise
from autograder.engine.stop import Stop
from autograder.engine.submission import UnusableSubmission
from autograder.report.console import NOTICE
from course_cli.options import CourseOption, JobsOption
from ros_runtime.course_error import COMMAND_FAILED, CommandFailed, CourseError

KEPT = ".kept"  # in the output folder: the finished students


def questions(
    exercise: Annotated[str, typer.Argument(help="the exercise, such as cancellable_walk")],
    submitted: Annotated[Path, typer.Argument(help="the folder of submissions, as `course grade` reads it")],
    out: Annotated[
        Path, typer.Option(help="folder for the pages; they go to OUT/EXERCISE", file_okay=False)
    ] = Path("questions"),
    student: Annotated[
        list[str] | None, typer.Option("--student", help="only for this student (can be repeated)")
    ] = None,
    number: Annotated[int, typer.Option(min=1, max=6, help="questions for each student")] = 3,
    nbgrader: Annotated[
        Path | None,
        typer.Option(
            metavar="FOLDER",
            help="also enter the questions, their keys and the answers in SUBMITTED into this nbgrader course, "
            "such as graded/; give the points in Formgrader",
        ),
    ] = None,
    jobs: JobsOption = os.cpu_count() or 1,
    course: CourseOption = None,
) -> None:
    """Make short questions for each student about their own program and its run, with keys for the examiner.

    The same student gets the same questions for the same program. After an interruption, type the same command again:
    finished students are kept.
    """
    console = Console(markup=False, highlight=False)
    loaded = load_exercise(exercise, hidden=False)
    is_program = len(loaded.file_names) == 1 and loaded.file_names[0].endswith(".py")
    if not is_program or any(not scenario.timed for check in loaded.checks for scenario in check.on):
        reason = "is not one program that runs with the robot, so it has no lines to ask about"
        raise CourseError(f"{exercise} {reason}")
    found = collect(submitted)
    for line in found.refused:
        console.print(f"left out: {line}", style=NOTICE)
    by_student = {work.student: work for work in found.works if work.exercise == exercise}
    missing = [name for name in student or () if name not in by_student]
    if missing or not by_student:
        raise CourseError(f"{submitted} has no submission of {exercise} by {', '.join(missing) or 'anybody'}")
    works = [work for name, work in by_student.items() if not student or name in student]
    try:
        sheets = _make(console, loaded, works, out / exercise / KEPT, number, jobs)
    except KeyboardInterrupt:
        raise CommandFailed("Interrupted. Type the same command again to continue.") from None
    write_pages(out / exercise, exercise, sheets)
    asked = sum(len(sheet.questions) for sheet in sheets)
    console.print(
        f"{asked} questions for {len(sheets)} students in {out / exercise}: {STUDENTS}/ to hand out; {EXAMINER} and "
        f"{TABLE} have the keys",
    )
    if nbgrader:
        try:
            marked = enter_questions(nbgrader, sheets, submitted, number)
        except NbgraderError as error:
            raise CommandFailed(str(error)) from error
        console.print(
            f"{marked} of {len(sheets)} students are marked; Formgrader, started in {nbgrader}, shows the others under "
            f"Manual Grading > {assignment_of(exercise)}",
        )
    raise typer.Exit(0 if asked else COMMAND_FAILED)


def _make(
    console: Console, exercise: Exercise, works: list[Work], folder: Path, number: int, jobs: int
) -> list[Sheet]:
    """Make the sheets that are not kept from an earlier run, with `jobs` arenas; return all, in order of student."""
    stop = Stop()

    def make(work: Work) -> Sheet:
        def say(doing: str) -> None:
            console.print(f"{work.student}: {doing}", style="dim")

        try:
            submission = work.read()
        except UnusableSubmission as error:
            return Sheet(work.student, exercise.name, note=f"no questions: {error}")
        path = folder / f"{work.student}.json"
        made_for = f"{submission.fingerprint} {checks_version(exercise.folder)} {number}"
        sheet = kept(path, made_for) or Maker(exercise, submission, number, stop, say).sheet()
        keep(path, sheet, made_for)
        return sheet

    sheets: list[Sheet] = []
    with ThreadPoolExecutor(jobs) as pool:
        try:
            for sheet in pool.map(make, works):
                sheets.append(sheet)
                line = f"{sheet.student}: {len(sheet.questions)} questions; {len(sheets)} of {len(works)} students"
                console.print(f"{line}{sheet.note and f' ({sheet.note})'}", soft_wrap=True)
        except BaseException:
            stop.set()
            pool.shutdown(cancel_futures=True)
            raise
    return sheets
