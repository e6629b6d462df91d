"""`course audit`: tests that each known fault is caught by the right check, and that no correct submission fails."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from autograder.classroom.audit.audit_record import AuditRecord, read_runs
from autograder.classroom.audit.fault_patch import SUFFIX, as_patch
from autograder.classroom.audit.generated.run import audit_generated, mutant_named
from autograder.classroom.audit.kill_matrix import kill_matrix, print_progress
from autograder.classroom.audit.known_submission import KnownSubmission, known_submission, known_submissions
from autograder.classroom.audit.run import AuditedRun
from autograder.classroom.audit.run import audit as audit_submissions
from autograder.engine.exercise import Exercise, exercise_names, load_exercise
from autograder.isolation.availability import available_isolation
from course_cli.options import CourseOption, JobsOption
from ros_runtime.course_error import COMMAND_FAILED, CommandFailed, CourseError

MATRIX_WIDTH = 140  # characters


def audit(
    context: typer.Context,
    exercise: Annotated[str | None, typer.Argument(help="the exercise (default: all of them)")] = None,
    jobs: JobsOption = 2,
    repeat: Annotated[
        int,
        typer.Option(min=1, help="number of times to grade each submission, each time with other inputs"),
    ] = 1,
    seed: Annotated[int, typer.Option(min=0, help="seed of the inputs in the first repetition")] = 0,
    only: Annotated[
        str,
        typer.Option(
            help="only submissions whose name matches, such as 'faulty/*'; mutants: 'rounds_a_number*'"
        ),
    ] = "*",
    scale: Annotated[
        float | None, typer.Option(help="factor by which the arenas' clock runs faster than real time")
    ] = None,
    generated: Annotated[
        bool,
        typer.Option(
            "--generated",
            help="make mutants, which are correct submissions with one mistake each, and grade them: each must lose a "
            "point. The first failed check ends a grading. At the end, print the diffs of the mutants that kept full "
            "marks, and what to do about them",
        ),
    ] = False,
    mutants: Annotated[
        int | None,
        typer.Option(
            min=1,
            help="number of mutants to grade for each exercise, chosen from each kind of mistake in turn "
            "(default: 60; 30 if the robot moves)",
        ),
    ] = None,
    json_file: Annotated[
        Path | None,
        typer.Option(
            "--json", help="write every verdict to this file, as soon as it is known", dir_okay=False
        ),
    ] = None,
    resume: Annotated[
        bool,
        typer.Option("--resume", help="reuse the gradings of unchanged submissions in the file of --json"),
    ] = False,
    show: Annotated[
        str | None,
        typer.Option(
            metavar="NAME", help="print one submission, such as faulty/sleeps, or what a mutant changes"
        ),
    ] = None,
    to_patch: Annotated[
        str | None,
        typer.Option(metavar="NAME", help="replace a program by a patch of the most similar correct one"),
    ] = None,
    robot: Annotated[
        str | None,
        typer.Option(help="grade the submissions of walking exercises on another robot, g1 (docs/robot.md)"),
    ] = None,
    course: CourseOption = None,
) -> None:
    """Grade submissions with known faults; exit status 0 only if every verdict is as expected."""
    console = Console(highlight=False)
    if generated and (ignored := _given(context, "repeat", "to_patch", "robot")):
        raise CourseError(
            f"--generated makes its own submissions, for the course's robot: leave out {ignored}"
        )
    if mutants and not generated:
        raise CourseError("--mutants is the number of mutants to grade: add --generated")
    if resume and json_file is None:
        raise CourseError("--resume continues with the file of --json: add --json FILE")
    if show and generated:
        _show_mutant(exercise, show)
        return
    if show:
        _show(_found(exercise, show))
        return
    if to_patch:
        console.print(_to_patch(_found(exercise, to_patch)), markup=False, soft_wrap=True)
        return
    earlier = read_runs(json_file) if resume and json_file else ()
    record = AuditRecord(json_file, isolation=available_isolation(), scale=scale, earlier=earlier)
    exercises = (load_exercise(name, hidden=True) for name in ([exercise] if exercise else exercise_names()))
    if robot:
        # imported only if needed, because it loads MuJoCo
        from autograder.other_robot import WALKING_EXERCISES, with_robot

        exercises = (with_robot(robot, one) for one in exercises if exercise or one.name in WALKING_EXERCISES)
    try:
        if generated:
            judged = [
                found
                for one in exercises
                for found in audit_generated(
                    one, record, console, number=mutants, only=only, jobs=jobs, seed=seed
                )
            ]
            found, is_as_expected = len(judged), all(one.noticed_by for one in judged)
        else:
            runs = [
                run
                for one in exercises
                for run in _audit(
                    console, one, record, only, jobs=jobs, repeat=repeat, seed=seed, robot=robot
                )
            ]
            found, is_as_expected = len(runs), not any(run.surprises() for run in runs)
    except KeyboardInterrupt:
        advice = (
            f"{json_file} has the finished gradings: add --resume to continue."
            if json_file
            else "No grading is saved."
        )
        raise CommandFailed(f"Interrupted. {advice}") from None
    if not found:
        raise CourseError(f"no {'mutant' if generated else 'submission'} matches {only!r}")
    raise typer.Exit(0 if is_as_expected else COMMAND_FAILED)


def _audit(
    console: Console,
    exercise: Exercise,
    record: AuditRecord,
    only: str,
    *,
    jobs: int,
    repeat: int,
    seed: int,
    robot: str | None,
) -> list[AuditedRun]:
    """Grade an exercise's submissions that are not in the record, and print the kill matrix of all its submissions."""

    def report(run: AuditedRun, is_earlier: bool) -> None:
        print_progress(console, run, earlier=is_earlier)

    known = known_submissions(exercise.name, only=only, robot=robot)
    runs = audit_submissions(known, exercise, record, report, jobs=jobs, repeat=repeat, seed=seed)
    console.print()
    console.print(kill_matrix(runs, exercise), width=max(console.width, MATRIX_WIDTH))
    console.print()
    return runs


def _given(context: typer.Context, *options: str) -> str:
    """Return which of these options were given on the command line, such as "--jobs, --seed"."""
    return ", ".join(
        f"--{option.replace('_', '-')}"
        for option in options
        if (source := context.get_parameter_source(option)) and source.name == "COMMANDLINE"
    )


def _found(exercise: str | None, name: str) -> KnownSubmission:
    """Return the submission of this name; `name` may begin with the exercise's name and a slash."""
    first, _, rest = name.partition("/")
    if exercise is None and first in exercise_names():
        return known_submission(first, rest)
    having = (
        [exercise] if exercise else [one for one in exercise_names() if known_submissions(one, only=name)]
    )
    if len(having) != 1:
        raise CourseError(
            f"{name} is a submission of {', '.join(having) or 'no exercise'}; give one exercise, too"
        )
    return known_submission(having[0], name)


def _show(known: KnownSubmission) -> None:
    """Print the program; print several files each with its name above it."""
    sources = known.read().sources
    for name, text in sources.items():
        if len(sources) > 1:
            print(f"# {name}")
        print(text, end="" if text.endswith("\n") else "\n")


def _show_mutant(exercise: str | None, name: str) -> None:
    """Print a mutant's sentence and diff; raises `CourseError` if there is no such mutant."""
    if exercise is None:
        raise CourseError(
            f"give the mutant's exercise, too: ./course audit EXERCISE --generated --show {name}"
        )
    mutant = mutant_named(exercise, name)
    print(mutant.sentence, *mutant.diff(), sep="\n")


def _to_patch(known: KnownSubmission) -> str:
    """Replace a program by its patch, unless too many lines differ; return a sentence that says what was done."""
    program = known.path
    if program.suffix != ".py":
        return f"{program} is not a program; nothing was changed"
    patch = as_patch(program, sorted((program.parents[1] / "correct").glob("*.py")))
    if patch is None:
        return f"{program.name} differs too much from every correct program; it was not replaced"
    program.with_suffix(SUFFIX).write_text(patch, encoding="utf-8")
    program.unlink()
    return f"{program.with_suffix(SUFFIX)}: {len(patch.splitlines())} lines"
