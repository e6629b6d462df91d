"""`course audit`: every check must catch its faults, and no correct submission may fail; mistakes cost points."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from autograder.classroom.audit.audit_record import AuditRecord, read_runs
from autograder.classroom.audit.fault_patch import SUFFIX, as_patch
from autograder.classroom.audit.generated.run import audit_generated, mutant_named
from autograder.classroom.audit.kill_matrix import kill_matrix, print_progress
from autograder.classroom.audit.known_submission import (
    HeaderError,
    KnownSubmission,
    known_submission,
    known_submissions,
)
from autograder.classroom.audit.leftovers import leftovers
from autograder.classroom.audit.run import AuditedRun
from autograder.classroom.audit.run import audit as audit_submissions
from autograder.engine.exercise import (
    Exercise,
    exercise_names,
    load_exercise,
)
from autograder.isolation.availability import available_isolation
from course_cli.ending import COULD_NOT, UNUSABLE, ended
from course_cli.options import CourseOption, JobsOption

MATRIX_WIDTH = 140


def audit(
    context: typer.Context,
    exercise: Annotated[str | None, typer.Argument(help="the exercise (default: all of them)")] = None,
    jobs: JobsOption = 2,
    repeat: Annotated[
        int,
        typer.Option(min=1, help="how often to grade each submission, each time with other scenario inputs"),
    ] = 1,
    seed: Annotated[int, typer.Option(min=0, help="scenario inputs of the first of these gradings")] = 0,
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
            help="make one mistake each in correct submissions, and grade them: all must lose points. The first "
            "failure ends a grading. At the end it prints the diffs of the survivors, and what to do about them",
        ),
    ] = False,
    mutants: Annotated[
        int | None,
        typer.Option(
            min=1,
            help="how many of them to grade of each exercise, of each kind of mistake in turn "
            "(default: 60; 30 where the robot moves)",
        ),
    ] = None,
    json_file: Annotated[
        Path | None, typer.Option("--json", help="write every verdict to this file, as soon as it is known")
    ] = None,
    resume: Annotated[
        bool,
        typer.Option(
            "--resume", help="continue with the file of --json: reuse its gradings of unchanged submissions"
        ),
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
    course: CourseOption = None,
) -> None:
    """Grade submissions with known faults; exit status 0 only if every verdict is as expected."""
    console = Console(highlight=False)
    audited: dict[str, list[AuditedRun]] = {}
    if generated and (ignored := _given(context, "repeat", "to_patch")):
        raise ended(console, f"--generated makes its own submissions: leave out {ignored}", UNUSABLE)
    if mutants and not generated:
        raise ended(console, "--mutants says how many to make: add --generated", UNUSABLE)
    if resume and json_file is None:
        raise ended(console, "--resume continues with the file of --json: add --json FILE", UNUSABLE)
    try:
        if show and generated:
            _show_mutant(exercise, show)
            return
        if show:
            _show(_found(exercise, show))
            return
        if to_patch:
            console.print(_to_patch(_found(exercise, to_patch)), markup=False, soft_wrap=True)
            return
        record = AuditRecord(
            json_file,
            isolation=available_isolation(),
            scale=scale,
            earlier=read_runs(json_file) if resume and json_file else (),
        )
        names = [exercise] if exercise else exercise_names()
        if generated:
            judged = []
            for one in (load_exercise(name, hidden=True) for name in names):
                judged += audit_generated(
                    one, record, console, number=mutants, only=only, jobs=jobs, seed=seed, scale=scale
                )
            if not judged:
                raise ended(console, f"no mutant matches {only!r}", UNUSABLE)
            raise typer.Exit(0 if all(one.noticed_by for one in judged) else COULD_NOT)
        with leftovers() as left:
            for name in names:
                known = known_submissions(name, only=only)
                audited[name] = _audit_all(console, known, name, record, jobs, repeat, seed, scale)
    except KeyboardInterrupt:
        go_on = (
            f"{json_file} has the finished gradings: add --resume to continue."
            if json_file
            else "Nothing is kept."
        )
        raise ended(console, f"Interrupted. {go_on}", COULD_NOT) from None
    every_run = [run for runs in audited.values() for run in runs]
    if not every_run:
        raise ended(console, f"no submission matches {only!r}", UNUSABLE)
    for line in left:
        console.print(f"left behind: {line}", style="red", markup=False)
    raise typer.Exit(COULD_NOT if left or any(run.surprises() for run in every_run) else 0)


def _audit_all(
    console: Console,
    submissions: Sequence[KnownSubmission],
    name: str,
    record: AuditRecord,
    jobs: int,
    repeat: int,
    seed: int,
    scale: float | None,
) -> list[AuditedRun]:
    """Grade the submissions that the record does not have, and print the kill matrix of all."""
    exercise = load_exercise(name, hidden=True)

    def earlier(known: KnownSubmission, repetition: int) -> AuditedRun | None:
        run = record.earlier_run(known, exercise, repetition, seed + repetition)
        if run:
            print_progress(console, run, earlier=True)
        return run

    def keep(run: AuditedRun) -> None:
        record.add(run, exercise)
        print_progress(console, run)

    runs = audit_submissions(
        submissions, exercise, jobs=jobs, repeat=repeat, seed=seed, scale=scale, earlier=earlier, report=keep
    )
    if runs:
        record.write()  # also when nothing was left to grade
    _print_matrix(console, runs, exercise)
    return runs


def _given(context: typer.Context, *options: str) -> str:
    """Return which of these options were given on the command line, such as "--jobs, --seed"."""
    sources = {option: context.get_parameter_source(option) for option in options}
    return ", ".join(
        f"--{option.replace('_', '-')}"
        for option, source in sources.items()
        if source and source.name == "COMMANDLINE"
    )


def _print_matrix(console: Console, runs: list[AuditedRun], exercise: Exercise) -> None:
    console.print()
    console.print(kill_matrix(runs, exercise), width=max(console.width, MATRIX_WIDTH))
    console.print()


def _found(exercise: str | None, name: str) -> KnownSubmission:
    """Return the submission of this name; `name` may begin with the exercise's."""
    first, _, rest = name.partition("/")
    if exercise is None and first in exercise_names():
        return known_submission(first, rest)
    having = (
        [exercise] if exercise else [one for one in exercise_names() if known_submissions(one, only=name)]
    )
    if len(having) != 1:
        raise HeaderError(
            f"{name} is a submission of {', '.join(having) or 'no exercise'}; name one: EXERCISE {name}"
        )
    return known_submission(having[0], name)


def _show(known: KnownSubmission) -> None:
    """Print the program; if there are several files, each below its name."""
    sources = known.read().sources
    for name, text in sources.items():
        if len(sources) > 1:
            print(f"# {name}")
        print(text, end="" if text.endswith("\n") else "\n")


def _show_mutant(exercise: str | None, name: str) -> None:
    """Print what is wrong with a mutant, and its diff; raises `HeaderError`."""
    if exercise is None:
        raise HeaderError(f"name the exercise of the mutant: EXERCISE --generated --show {name}")
    mutant = mutant_named(exercise, name)
    print(mutant.sentence, *mutant.diff(), sep="\n")


def _to_patch(known: KnownSubmission) -> str:
    """Replace a program by its patch, unless too little is shared; return what was done, as a sentence."""
    program = known.path
    if program.suffix != ".py":
        return f"{program} is no program; nothing was changed"
    patch = as_patch(program, sorted((program.parents[1] / "correct").glob("*.py")))
    if patch is None:
        return f"{program.name} shares too little with any correct one; it stays whole"
    program.with_suffix(SUFFIX).write_text(patch, encoding="utf-8")
    program.unlink()
    return f"{program.with_suffix(SUFFIX)}: {len(patch.splitlines())} lines"
