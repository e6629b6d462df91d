"""A batch that is killed at any moment goes on with --resume: no grade is lost, none is there twice."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import psutil
import pytest
from nbgrader.api import Gradebook

STUDENTS = [f"student{number}" for number in range(4)]
ROUNDS = [
    ("cache/*/*.json", 1),
    ("gradebook.db", 1),
    ("autograded/*/*", 2),
    ("feedback/*/*/*.html", 3),
]
POINTS = "import sys; from autograder.batch import job; from autograder.engine.verdict import CheckVerdict, Grade\n"
POINTS += """
def all_points(submission, exercise, *, seed, isolation, report, **options):
    with open(sys.argv.pop(), "a") as log:
        log.write(submission.student + chr(10))
        sys.argv.append(log.name)
    verdicts = [CheckVerdict(check.id, check.title, "passed", check.points, check.points) for check in exercise.checks]
    return Grade(exercise.name, submission.student, isolation.label, verdicts, seed=seed)

job.grade = all_points
from course_cli.app import main
main(sys.argv[1:-1])
"""


def start(folder: Path) -> subprocess.Popen[bytes]:
    """`course grade --resume`, with a function that gives all points in the place of the arenas."""
    arguments = ["grade", folder / "submitted", "--out", folder / "graded", "--resume", "--jobs", "1"]
    return subprocess.Popen(
        [sys.executable, "-c", POINTS, *arguments, folder / "log"],
        env={**os.environ, "COURSE_ISOLATION": "none"},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )


@pytest.mark.parametrize("exercise", ["battery_service"])
def test_kills_lose_and_double_nothing(tmp_path: Path, exercise: str) -> None:
    for student in STUDENTS:
        (tmp_path / "submitted" / student).mkdir(parents=True)
        (tmp_path / "submitted" / student / f"{exercise}.py").write_text(f"name = {student!r}\n")
    kills = 0
    for pattern, number in ROUNDS:
        with start(tmp_path) as grader:
            while len(list((tmp_path / "graded").glob(pattern))) < number and grader.poll() is None:
                pass  # not a sleep: the moment after the file appears is what the kill has to hit
            if grader.poll() is None:
                psutil.Process(grader.pid).kill()
                kills += 1
    assert kills >= 3

    with start(tmp_path) as grader:
        said, _ = grader.communicate()
    assert grader.returncode == 0, said.decode()
    grades = json.loads((tmp_path / "graded/grades.json").read_text())
    assert [grade["student"] for grade in grades] == STUDENTS
    assert {grade["score"] for grade in grades} == {grades[0]["max_score"]}
    for student in STUDENTS:
        assert len(json.loads((tmp_path / f"graded/records/{student}.json").read_text())) == 1
        page = tmp_path / f"graded/feedback/{student}/{exercise}/{exercise}.html"
        assert page.read_text().rstrip().endswith("</html>")
    with Gradebook(f"sqlite:///{tmp_path / 'graded/gradebook.db'}") as db:
        entered = {each.student.id: each.score for each in db.assignment_submissions(exercise)}
    assert entered == dict.fromkeys(STUDENTS, grades[0]["score"])
    assert len((tmp_path / "log").read_text().splitlines()) <= len(STUDENTS) + kills
