"""`nbgrader export` writes the same rows as `course export`, and no zero for a missing score."""

from __future__ import annotations

import csv
import dataclasses
import subprocess
import sys
from pathlib import Path

from made_up_grades import FAILED, grade_of
from nbgrader.api import Gradebook

from autograder.classroom.export.grades_csv import row_of, table_text
from autograder.classroom.export.published import publish
from autograder.classroom.nbgrader_bridge.gradebook import Entry

SOURCES = {"battery_service.py": "print('a program')\n"}
EXPORTER = "--exporter=autograder.classroom.nbgrader_bridge.class_export.ClassExport"


def nbgrader(course: Path, *arguments: str) -> str:
    """Run nbgrader's own command in the folder of the course; return what it logs."""
    program = Path(sys.executable).with_name("nbgrader")
    done = subprocess.run(
        [program, "export", *arguments], cwd=course, capture_output=True, text=True, timeout=120
    )
    assert done.returncode == 0, done.stderr
    return done.stderr


def test_a_gradebook_exports_the_same_rows_and_leaves_out_what_has_no_score(gradebook, course):
    grades = [
        grade_of("anna"),
        grade_of("bert", follows_the_battery=FAILED, server_appears=FAILED),
        grade_of("cleo", ends_cleanly=FAILED),
    ]
    for grade in grades:
        gradebook.enter(Entry(grade, SOURCES))
    gradebook.enter(Entry(dataclasses.replace(grades[2], reason="no arena could start"), SOURCES))
    with Gradebook(f"sqlite:///{course / 'gradebook.db'}") as db:
        db.add_student("dora")

    log = nbgrader(course, EXPORTER, "--to", "all.csv")

    wanted = table_text(row_of(publish(grade, "hide")) for grade in grades[:2])
    assert (course / "all.csv").read_text() == wanted
    assert "battery_service of cleo is not graded: left out" in log
    assert "battery_service of dora is missing: left out" in log

    with Gradebook(f"sqlite:///{course / 'gradebook.db'}") as db:
        cell = db.find_grade("follows_the_battery", "battery_service", "battery_service", "bert")
        cell.manual_score = cell.max_score
        db.db.commit()
    nbgrader(course, "--student", '["bert"]')  # the exporter is that of the folder's configuration

    (row,) = csv.DictReader((course / "grades.csv").open())
    follows = next(check for check in grades[1].checks if check.id == "follows_the_battery")
    assert row["student_id"] == "bert"
    assert float(row["score"]) == grades[1].score + follows.max_points
