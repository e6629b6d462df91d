"""`course demo`: shows the toolkit in one minute, also on a machine without a screen."""

from __future__ import annotations

import contextlib
import io
import json
import os
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Annotated

import typer
from rich.console import Console
from rich.table import Table
from rich.text import Text

import lab
from autograder.authoring.evidence.transcript import Transcript
from autograder.classroom.audit.known_submission import known_submission
from autograder.engine.exercise import load_exercise
from autograder.engine.grading import GradingOptions, Watcher, grade
from autograder.engine.submission import read_submission
from autograder.engine.verdict import CheckVerdict, Grade
from autograder.report.rendering import Section, write_page
from autograder.report.sequence import transcript_svg
from autograder.report.table import MARKS, summary
from course_cli.options import JobsOption
from humanoid_interfaces.action import WalkTo
from ros_runtime.course_error import COMMAND_FAILED, NOT_GRADED, CourseError
from ros_runtime.project import PROJECT

EXERCISE = "cancellable_walk"
SOLUTION = PROJECT / "solutions" / EXERCISE / f"{EXERCISE}.ipynb"
FAULTY = {"ignores cancel": "faulty/ignores_cancel", "crashes": "faulty/crashes_in_execute"}


class DemoFailed(CourseError):
    """A step of the demo did not have the expected result."""

    exit_status = COMMAND_FAILED

    def __str__(self) -> str:
        return f"The demo failed: {super().__str__()}"


class DemoNotGraded(DemoFailed):
    """A submission could not be graded, because the machine was too busy."""

    exit_status = NOT_GRADED


def demo(
    out: Annotated[
        Path | None,
        typer.Option(help="folder of the report (default: demo/ in the clone, or here)", file_okay=False),
    ] = None,
    jobs: JobsOption = 2,
) -> None:
    """Show the whole toolkit at work: a walk, a cancel, three graded submissions."""
    if out is None:
        out = PROJECT / "demo" if os.access(PROJECT, os.W_OK) else Path("demo")
    out.mkdir(parents=True, exist_ok=True)
    # The console keeps the real sys.stdout, which is replaced below to hide the lab's output.
    console = Console(file=sys.stdout, highlight=False)
    try:
        figures = _walk_and_cancel(console)
    except lab.LabError as error:
        raise DemoFailed(error) from error
    grades, sections = _grade_three(console, jobs)
    _require_expected(grades)
    console.print(_comparison(grades))
    report = out / "report.html"
    write_page(
        report,
        title="A humanoid that balances, a goal that is cancelled, three servers that are graded",
        introduction="A reference server walked the robot 0.8 m, and its second goal was cancelled in mid-stride. Then "
        "three submissions were graded by what they did, each in arenas of its own.",
        figures=figures,
        sections=sections,
    )
    (out / "grades.json").write_text(json.dumps([grade.to_json() for grade in grades], indent=2) + "\n")
    console.print(f"Pictures, diagrams and every verdict: {report}", markup=False, soft_wrap=True)


def _walk_and_cancel(console: Console) -> list[str]:
    """Walk the live robot with the reference server, and cancel a goal; return figures for the report."""
    console.print("1  The robot stands up in MuJoCo, and the reference server starts beside it", style="bold")
    submission = read_submission(SOLUTION, EXERCISE)
    # The lab's output is meant for notebooks, so it is not shown here.
    quiet = contextlib.redirect_stdout(io.StringIO())
    with TemporaryDirectory() as folder, quiet, contextlib.ExitStack() as end:
        end.callback(lab.stop_everything)
        lab.start_robot()
        file = Path(folder) / f"{EXERCISE}.py"
        file.write_bytes(submission.files[file.name])
        lab.run_node(file)

        console.print("2  It walks 0.8 m ahead", style="bold")
        walk = _send_accepted(0.8)
        lab.wait_until(lambda: len(walk.feedback) >= 8 or walk.is_over, timeout=30)
        figures = [_html(lab.show_robot())]
        outcome = walk.result(timeout=60)
        figures.append(_html(lab.draw_sequence("A walk of 0.8 m")))
        result = outcome.result
        console.print(
            f"   {outcome.status}: x = {result.final_pose.pose.position.x:.2f} m after {result.total_steps} steps, "
            f"{len(walk.feedback)} feedback messages"
        )
        if outcome.status != "SUCCEEDED":
            raise DemoFailed(f"the walk ended {outcome.status}: {result.error_msg}")

        console.print("3  A second walk is cancelled in mid-stride", style="bold")
        walk = _send_accepted(3.0)
        lab.wait_until(lambda: len(walk.feedback) >= 10 or walk.is_over, timeout=30)
        walk.cancel()
        outcome = walk.result(timeout=30)
        lab.wait_until(lambda: lab.mode() == "STANDING", timeout=10)
        figures += [_html(lab.draw_sequence("A walk that is cancelled")), _html(lab.show_robot())]
        console.print(f"   {outcome.status}: the robot stands at {lab.pose()}")
        if outcome.status != "CANCELED":
            raise DemoFailed(f"the canceled walk ended {outcome.status}")
    return figures


def _grade_three(console: Console, jobs: int) -> tuple[list[Grade], list[Section]]:
    console.print("4  Three submissions are graded by what they do, each in arenas of its own", style="bold")
    exercise = load_exercise(EXERCISE, hidden=False)
    grades, sections = [], []
    submissions = [
        read_submission(SOLUTION, EXERCISE, student="right"),
        *(
            replace(known_submission(EXERCISE, name).read(), student=student)
            for student, name in FAULTY.items()
        ),
    ]
    for submission in submissions:
        diagrams: dict[str, list[str]] = {}

        def keep(
            verdict: CheckVerdict, runs: Sequence[Transcript], diagrams: dict[str, list[str]] = diagrams
        ) -> None:
            if verdict.status == "failed":
                diagrams[verdict.id] = [transcript_svg(runs[-1], verdict.title)]

        name = submission.student
        with console.status(f"   {name} …"):
            result = grade(submission, exercise, GradingOptions(jobs=jobs), Watcher(on_evidence=keep))
        console.print(f"   {name}: {summary(result)}", markup=False)
        grades.append(result)
        sections.append(Section(f"Submission: {name}", result, diagrams))
    return grades, sections


def _require_expected(grades: Sequence[Grade]) -> None:
    for given in grades:
        if given.status == "not graded":
            raise DemoNotGraded(
                f"“{given.student}” could not be graded: {given.why_not_graded}\n"
                "Next: ./course demo --jobs 1, when the machine is less busy."
            )
    right, *wrong = grades
    if not right.all_passed:
        raise DemoFailed("the reference solution did not get full marks; look at demo/grades.json")
    for faulty in wrong:
        if faulty.all_passed:
            raise DemoFailed(f"the faulty submission “{faulty.student}” got full marks")


def _comparison(grades: Sequence[Grade]) -> Table:
    table = Table(show_edge=False)
    table.add_column("check", overflow="fold")
    for graded in grades:
        table.add_column(graded.student, justify="center")
    for row in zip(*(graded.checks for graded in grades), strict=True):
        table.add_row(row[0].title, *(Text(*MARKS[verdict.status]) for verdict in row))
    table.add_section()
    table.add_row("points", *(f"{graded.score}/{graded.max_score}" for graded in grades))
    return table


def _send_accepted(distance: float) -> lab.Goal:
    """Send goals until one is accepted, because the server rejects goals until it has received the robot's state."""
    sent: list[lab.Goal] = []

    def is_accepted() -> bool:
        sent.append(lab.send_goal("walk_to", WalkTo, _ahead(distance)))
        return sent[-1].accepted

    lab.wait_until(is_accepted, timeout=20, what="the server accepts a goal")
    return sent[-1]


def _ahead(distance: float) -> WalkTo.Goal:
    """Return a goal `distance` m ahead of the robot, in odom."""
    here = lab.pose()
    goal = WalkTo.Goal()
    goal.target_pose.header.frame_id = "odom"
    goal.target_pose.pose.position.x = here.x + distance
    goal.target_pose.pose.position.y = here.y
    goal.target_pose.pose.orientation.w = 1.0
    return goal


def _html(display: object) -> str:
    return str(getattr(display, "data"))  # noqa: B009  IPython's HTML declares no attributes
