"""`course requests`: reads students' regrade requests, grades each program again, and drafts the replies."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.table import Table
from rich.text import Text

from autograder.classroom.batch.folder_lock import locked
from autograder.classroom.regrade_requests import (
    TABLE,
    UnusableRequests,
    collect_evidence,
    new_requests,
    read_state,
    write_state,
)
from autograder.report.console import BAD
from course_cli.options import CourseOption, JobsOption
from ros_runtime.course_error import COMMAND_FAILED


def requests(
    inbox: Annotated[
        Path,
        typer.Argument(
            help="a folder of students' forms (.md, .txt) and tables, or a table with student, exercise, check, why",
            exists=True,
        ),
    ],
    graded: Annotated[Path, typer.Option(help="the output folder of `course grade`")] = Path("graded"),
    out: Annotated[Path, typer.Option(help=f"folder for {TABLE} and the evidence", file_okay=False)] = Path(
        "requests"
    ),
    jobs: JobsOption = os.cpu_count() or 1,
    course: CourseOption = None,
) -> None:
    """Grade the programs of regrade requests again, and draft the replies.

    Each program is graded with the seed of its grade, and recorded. Grades stay as they are: a person decides, and
    writes the state and a name to requests.csv.
    """
    console = Console(highlight=False)
    out.mkdir(parents=True, exist_ok=True)
    with locked(out):
        state = read_state(out)
        asked, unusable = new_requests(inbox, state)
        state += asked
        write_state(out, state)
        for problem in unusable:
            console.print(f"left out: {problem}", style=BAD, markup=False)
        failed = bool(unusable)
        for index, request in enumerate(state):
            if request.second_run or request.state != "open":
                continue
            console.print(f"grading again: {request.student} · {request.exercise}", style="dim", markup=False)
            try:
                evidence = collect_evidence(request, graded, out, jobs)
            except UnusableRequests as error:
                console.print(f"request {request.number}: {error}", style=BAD, markup=False)
                failed = True
                continue
            state[index] = replace(request, second_run=evidence.result)
            write_state(out, state)
            failed |= bool(evidence.differences)
    table = Table(show_edge=False)
    for title in ("request", "student", "exercise", "check", "state", "second run"):
        table.add_column(title, overflow="fold", no_wrap=title == "exercise")
    for request in state:
        colour = "bold red" if request.second_run.startswith("DIFFERS") else ""
        cells = [
            str(request.number),
            request.student,
            request.exercise,
            request.check or "all",
            request.state,
        ]
        table.add_row(*map(Text, cells), Text(request.second_run or "not run", colour))
    console.print(table)
    console.print(
        f"drafts: {out}/<number>/reply.md; write your decisions to {out / TABLE}", style="dim", markup=False
    )
    raise typer.Exit(COMMAND_FAILED if failed else 0)
