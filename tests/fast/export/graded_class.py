"""A graded class of five: correct, failing a hidden check, not graded, and an essay marked and one waiting."""

from __future__ import annotations

from dataclasses import replace
from datetime import datetime, timezone
from pathlib import Path

from autograder.classroom.batch.records import GRADES, write_grades
from autograder.classroom.export.published import Options
from autograder.engine.verdict import CheckVerdict, Grade

SECRETS = (
    "a secret title",
    "what only instructors see",
    "the secret next step",
    "the secret log",
    "secret_id",
    "secret expectation",
)
GRADED_AT = datetime(2026, 3, 1, 12, 30, 5, tzinfo=timezone.utc)
OPTIONS = Options(GRADED_AT, classroom="robotics")
HOSTILE = '=HYPERLINK("http://evil")\x00\x1b[31m<script>alert(1)</script> ]]> \ud800 “Grüße” 机器人\n+1'


WORKSHEET = """Identifier,Full name,Email address,Status,Grade,Maximum grade,Last modified (grade),Feedback comments
Participant 9001,Anna Lee,anna@x.org,Submitted,,5.00,-,
Participant 9002,Bert O'Neil,bert@x.org,Submitted,,5.00,-,
"""


def visible(status: str = "passed", **more: object) -> CheckVerdict:
    points = 3 if status == "passed" else 0
    verdict = CheckVerdict("answers", "The server answers in time", status, points, 3)  # type: ignore[arg-type]
    return replace(verdict, **more)  # type: ignore[arg-type]


def hidden(status: str = "passed") -> CheckVerdict:
    return CheckVerdict(
        "secret_id",
        "a secret title",
        status,  # type: ignore[arg-type]
        2 if status == "passed" else 0,
        2,
        expected="secret expectation",
        observed="what only instructors see",
        help="the secret next step",
        log="the secret log",
        hidden=True,
    )


def grade(student: str, *checks: CheckVerdict, exercise: str = "battery_service", reason: str = "") -> Grade:
    return Grade(exercise, student, "namespaces", list(checks), reason=reason, seed=7)


ANNA = grade("anna", visible(), hidden())
BERT = grade(
    "bert",
    visible(
        "failed",
        expected="an answer",
        observed=HOSTILE,
        help="call spin",
        log=f"{HOSTILE}\nbye",
        robot_time=2.5,
    ),
    CheckVerdict("ends", "It ends", "not run", 0, 1, help="Needs a check that did not pass."),
    hidden("failed"),
)
CLEO = grade("cleo", visible("error"), hidden("error"), reason="secret_id: a secret title broke")
DORA = grade("dora", CheckVerdict("graph", "A clear graph", "marked", 2.5, 4), exercise="arm_architecture")
EMIL = grade("emil", CheckVerdict("graph", "A clear graph", "to mark", 0, 4), exercise="arm_architecture")
SAME = grade("bert", visible("failed"), *ANNA.checks[1:])  # of as many points as Anna's
CLASS = [ANNA, BERT, CLEO, DORA, EMIL]


def graded_folder(folder: Path, *grades: Grade) -> Path:
    write_grades(folder / GRADES, grades or CLASS)
    return folder
