"""Invented grades, for the tests of nbgrader's gradebook and pages."""

from __future__ import annotations

import dataclasses
from pathlib import Path

from autograder.engine.exercise import load_exercise
from autograder.engine.verdict import CheckVerdict, Grade

ROOT = Path(__file__).resolve().parents[3]
SOLUTIONS = ROOT / "solutions"


def grade_of(
    student: str, exercise: str = "battery_service", *, hidden: bool = True, **verdicts: dict
) -> Grade:
    """A grade in which every check passed; keyword arguments change verdicts: check id → fields of its verdict."""
    checks = [
        dataclasses.replace(
            CheckVerdict(
                check.id,
                check.title,
                "passed",
                check.points,
                check.points,
                hidden=check.hidden,
                robot_time=1.5,
            ),
            **verdicts.get(check.id, {}),
        )
        for check in load_exercise(exercise, hidden=hidden).checks
    ]
    assert set(verdicts) <= {check.id for check in checks}
    return Grade(exercise, student, "namespaces" if hidden else "untrusted", checks)


FAILED = {
    "status": "failed",
    "points": 0,
    "expected": "what should be",
    "observed": "what was",
    "help": "what to do",
}
