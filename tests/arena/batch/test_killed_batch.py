"""After a kill at any moment a batch continues with --resume: no grade is lost or duplicated."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

from nbgrader.api import Gradebook

EXERCISE = "battery_service"
STUDENTS = [f"student{number}" for number in range(3)]
# For each run: the audit event at which it is killed, and its count, from the batch's first file to its last.
KILLS = [
    ("os.rename", "batch.json", 1),
    ("os.rename", "cache/*", 2),
    ("os.rename", "grades.json", 1),
    ("sqlite3.connect", "gradebook.db", 2),
    ("open", "release/*", 1),
    ("os.rename", "submitted/*", 1),
    ("open", "autograded/*", 2),
    ("open", "feedback/*", 2),
    ("os.rename", "sources/*", 2),
    ("open", "class.html", 1),
]
# Imports everything once, then forks for each run of `course grade`. A function that gives full marks replaces arenas.
# Python's audit events announce each operation; a file that is written atomically appears by a rename.
RUNS = """
import fnmatch, json, os, signal, sys
from autograder.classroom.batch import job
from autograder.engine.verdict import CheckVerdict, Grade
from course_cli.app import main
import autograder.classroom.commands.grade

folder, kills = sys.argv[1], json.loads(sys.argv[2])

def all_points(submission, exercise, options, watcher, **_):
    with open(folder + "/log", "a") as log:
        log.write(submission.student + chr(10))
    verdicts = [CheckVerdict(check.id, check.title, "passed", check.points, check.points) for check in exercise.checks]
    return Grade(exercise.name, submission.student, options.isolation.label, verdicts, seed=options.seed)

def die_before(act, place, time):
    times = []
    def look(event, arguments):
        if event != act or not fnmatch.fnmatch(str(arguments[event == "os.rename"]), f"{folder}/graded/{place}"):
            return
        if event != "open" or arguments[2] & (os.O_WRONLY | os.O_RDWR):
            times.append(event)
            if len(times) == time:
                os.kill(os.getpid(), signal.SIGKILL)
    sys.addaudithook(look)

job.grade = all_points
statuses = []
for kill in (*kills, None):
    if (child := os.fork()) == 0:
        if kill:
            die_before(*kill)
        main(["grade", folder + "/submitted", "--out", folder + "/graded", "--resume", "--jobs", "1"])
    statuses.append(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
with open(folder + "/statuses", "w") as file:
    json.dump(statuses, file)
"""


def test_after_ten_kills_no_grade_is_lost_or_duplicated(tmp_path: Path) -> None:
    for student in STUDENTS:
        (tmp_path / "submitted" / student).mkdir(parents=True)
        (tmp_path / "submitted" / student / f"{EXERCISE}.py").write_text(f"name = {student!r}\n")
    ran = subprocess.run(
        [sys.executable, "-c", RUNS, tmp_path, json.dumps(KILLS)],
        env={**os.environ, "COURSE_ISOLATION": "none"},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    assert ran.returncode == 0, ran.stdout
    assert json.loads((tmp_path / "statuses").read_text()) == [-9] * len(KILLS) + [0], ran.stdout

    grades = json.loads((tmp_path / "graded/grades.json").read_text())
    assert [grade["student"] for grade in grades] == STUDENTS
    assert {grade["score"] for grade in grades} == {grades[0]["max_score"]}
    for student in STUDENTS:
        assert len(json.loads((tmp_path / f"graded/records/{student}.json").read_text())) == 1
        page = tmp_path / f"graded/feedback/{student}/{EXERCISE}/{EXERCISE}.html"
        assert page.read_text().rstrip().endswith("</html>")
        assert (tmp_path / f"graded/pages/{student}/{EXERCISE}.html").read_text().rstrip().endswith("</html>")
    with Gradebook(f"sqlite:///{tmp_path / 'graded/gradebook.db'}") as db:
        entered = {each.student.id: each.score for each in db.assignment_submissions(EXERCISE)}
    assert entered == dict.fromkeys(STUDENTS, grades[0]["score"])
    # one grade was stored before the second kill, so each other submission is graded at most twice
    assert len((tmp_path / "log").read_text().splitlines()) <= 2 * len(STUDENTS) - 1
