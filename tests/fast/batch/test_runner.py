"""A batch continues, whatever happens to one submission."""

from __future__ import annotations

import threading
from contextlib import closing

import pytest

from autograder.classroom.batch import job as module
from autograder.classroom.batch.cache import GradeCache
from autograder.classroom.batch.collection import Work
from autograder.classroom.batch.job import BatchWatcher
from autograder.classroom.batch.runner import BatchRunner
from autograder.engine.exercise import load_exercise
from autograder.engine.stop import Stopped
from autograder.engine.verdict import CheckVerdict, Grade
from autograder.isolation.arena_process import Kind
from autograder.isolation.availability import Isolation
from student_work import work_at

ISOLATED = Isolation(Kind.NAMESPACES, "as a test says")
CHECKS = load_exercise("battery_service", hidden=True).checks


def grade_by_content(submission, exercise, options, watcher, **_):
    """Stands for the arenas: grades by a word in the source, so that the tests test only the batch."""
    (source,) = submission.sources.values()
    if "crash" in source:
        raise OSError("no space left on device")
    status = "error" if "busy" in source else "passed"
    points = 0 if status == "error" else 1
    verdicts = [
        CheckVerdict(
            check.id, check.title, status, points, 1, help="the machine was too busy", hidden=check.hidden
        )
        for check in exercise.checks
    ]
    for verdict in verdicts:
        watcher.on_verdict(verdict)
    return Grade(exercise.name, submission.student, options.isolation.label, verdicts)


@pytest.fixture
def works(tmp_path):
    sources = {"anna": "right", "bert": "crash", "carl": "busy", "dora": "right"}
    for student, source in sources.items():
        (tmp_path / f"{student}.py").write_text(source)
    found = [work_at(tmp_path / f"{student}.py", student, "battery_service") for student in sources]
    return [*found, Work("emil", "battery_service")]


def batch(tmp_path, isolation=ISOLATED, **options):
    return BatchRunner(GradeCache(tmp_path / "cache", isolation), isolation, jobs=2, **options)


def test_infrastructure_failures_are_not_graded_and_bad_submissions_are_zero(tmp_path, works, monkeypatch):
    monkeypatch.setattr(module, "grade", grade_by_content)
    results = {result.work.student: result for result in batch(tmp_path).run(works)}
    status = {student: (result.grade.status, result.grade.score) for student, result in results.items()}
    assert status == {
        "anna": ("graded", len(CHECKS)),
        "bert": ("not graded", None),
        "carl": ("not graded", None),
        "dora": ("graded", len(CHECKS)),
        "emil": ("graded", 0),
    }
    assert "no space left on device" in results["bert"].grade.reason
    assert "the machine was too busy" in results["carl"].grade.reason
    first = results["emil"].grade.checks[0]
    assert "neither battery_service.ipynb nor battery_service.py" in first.observed
    assert results["emil"].sources is None
    assert results["emil"].grade.max_score == sum(check.points for check in CHECKS)


def test_resume_grades_only_submissions_without_a_grade(tmp_path, works, monkeypatch):
    monkeypatch.setattr(module, "grade", grade_by_content)
    list(batch(tmp_path).run(works))
    again = {result.work.student: result.cached for result in batch(tmp_path, resume=True).run(works)}
    assert again == {"anna": True, "bert": False, "carl": False, "dora": True, "emil": False}
    assert not any(result.cached for result in batch(tmp_path).run(works))


def test_every_check_is_reported_once(tmp_path, works, monkeypatch):
    monkeypatch.setattr(module, "grade", grade_by_content)
    reported = []
    list(batch(tmp_path, watcher=BatchWatcher(reported.append)).run([works[0], works[-1]]))
    assert len(reported) == 2 * len(CHECKS)


def test_without_isolation_only_visible_checks_are_made(tmp_path, works, monkeypatch):
    monkeypatch.setattr(module, "grade", grade_by_content)
    untrusted = batch(tmp_path, isolation=Isolation(Kind.NONE, "no bubblewrap"))
    for result in untrusted.run([works[0], works[-1]]):
        assert result.grade.isolation == "untrusted"
        assert not any(verdict.hidden for verdict in result.grade.checks)


def test_leaving_early_ends_running_gradings_and_starts_no_more(tmp_path, works, monkeypatch):
    started = []
    second_is_running = threading.Event()

    def until_stopped(submission, exercise, options, watcher, *, stop, **_):
        started.append(submission.student)
        if submission.student == "anna":
            assert second_is_running.wait(10)
            return grade_by_content(submission, exercise, options, watcher)
        second_is_running.set()
        while not stop.is_set():
            pass
        raise Stopped

    monkeypatch.setattr(module, "grade", until_stopped)
    blocked = [
        works[0],
        *(Work(name, "battery_service", works[3].candidates) for name in ("fred", "gina", "hans")),
    ]
    with closing(batch(tmp_path).run(blocked)) as results:
        assert next(results).work.student == "anna"
    assert "hans" not in started
