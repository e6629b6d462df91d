"""A resumed batch reuses cached grades, but never for another submission or other checks."""

from __future__ import annotations

import pytest

from autograder.classroom.batch import version as module
from autograder.classroom.batch.cache import CachedGrade, GradeCache
from autograder.classroom.batch.job import Effort
from autograder.classroom.batch.version import checks_version
from autograder.engine.exercise import load_exercise
from autograder.engine.submission import Submission
from autograder.engine.verdict import CheckVerdict, Grade
from autograder.isolation.arena_process import Kind
from autograder.isolation.availability import Isolation

ISOLATED = Isolation(Kind.NAMESPACES, "as a test says")
EXERCISE = load_exercise("battery_service", hidden=True)
TOOK = Effort("2026-03-01T12:00:00+00:00", "2026-03-01T12:00:40+00:00", "a-host", 21.5, 2, 9)
ANNA = Submission("battery_service", "anna", {"battery_service.py": "x = 1\n"})


def passed(submission, status="passed"):
    checks = [
        CheckVerdict(check.id, check.title, status, check.points, check.points) for check in EXERCISE.checks
    ]
    return Grade(submission.exercise, submission.student, "namespaces", checks)


@pytest.fixture
def cache(tmp_path):
    cache = GradeCache(tmp_path, ISOLATED)
    cache.put(ANNA, EXERCISE, 0, CachedGrade(passed(ANNA), TOOK))
    return cache


def test_the_same_work_has_the_same_grade_and_what_it_took(cache):
    assert cache.get(ANNA, EXERCISE, 0) == CachedGrade(passed(ANNA), TOOK)


def test_the_same_source_by_another_student_has_it_in_that_students_name(cache):
    bert = Submission("battery_service", "bert", ANNA.sources)
    assert cache.get(bert, EXERCISE, 0) == CachedGrade(passed(bert), TOOK)


def test_another_source_seed_isolation_or_set_of_checks_is_graded_anew(cache, tmp_path):
    assert (
        cache.get(Submission("battery_service", "anna", {"battery_service.py": "x = 2\n"}), EXERCISE, 0)
        is None
    )
    assert cache.get(ANNA, EXERCISE, 1) is None
    assert GradeCache(tmp_path, Isolation(Kind.NONE, "")).get(ANNA, EXERCISE, 0) is None
    assert cache.get(ANNA, load_exercise("battery_service", hidden=False), 0) is None


def test_an_ungraded_submission_is_not_cached(tmp_path):
    cache = GradeCache(tmp_path, ISOLATED)
    cache.put(ANNA, EXERCISE, 0, CachedGrade(passed(ANNA, status="error"), TOOK))
    assert cache.get(ANNA, EXERCISE, 0) is None


@pytest.mark.parametrize(
    ("changed", "matters"),
    [
        ("solutions/battery_service/hidden.py", True),
        ("autograder/authoring/requirements/server_checks.py", True),
        ("autograder/engine/grading.py", True),
        ("robot_sim/walking/gait.py", True),
        ("solutions/cancellable_walk/checks.py", False),
        ("solutions/battery_service/known/faulty/sleeps.py", False),
        ("autograder/report/table.py", False),
        ("autograder/classroom/export/canvas.py", False),
        ("autograder/classroom/hidden_checks/standard_hidden.py", True),
    ],
)
def test_a_change_of_the_checks_invalidates_cached_grades(tmp_path, monkeypatch, changed, matters):
    for name in ("autograder/engine/grading.py", changed):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text("before")
    monkeypatch.setattr(module, "PROJECT", tmp_path)
    checks_version.cache_clear()
    before = checks_version(tmp_path / "solutions" / "battery_service")
    (tmp_path / changed).write_text("after")
    checks_version.cache_clear()
    assert (checks_version(tmp_path / "solutions" / "battery_service") != before) == matters
    checks_version.cache_clear()
