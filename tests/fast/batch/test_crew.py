"""Jobs of a killed worker and ungraded jobs are repeated once, and every job has one outcome."""

from __future__ import annotations

import os
from collections import Counter
from concurrent.futures import Executor, ProcessPoolExecutor
from functools import partial
from multiprocessing import get_context
from pathlib import Path

import pytest

from autograder.classroom.batch.job import GradingJob, Outcome
from autograder.classroom.batch.worker_pool import WorkerPool, Workers, threads
from autograder.engine.verdict import CheckVerdict, Grade

FORKING = get_context("forkserver")
FORKING.set_forkserver_preload([__name__])  # so that the workers of each pool import nothing


def new_pool() -> Executor:
    return ProcessPoolExecutor(2, mp_context=FORKING)


def job(student: str) -> GradingJob:
    return GradingJob(student, "battery_service", {"battery_service.py": ""}, 0, True, "version")


def passes(job: GradingJob) -> Grade:
    return Grade(job.exercise, job.student, "namespaces", [CheckVerdict("id", "title", "passed", 1, 1)])


def grade_or_die(folder: Path, job: GradingJob) -> Outcome:
    """Grade a job; the first try of `once` and every try of `always` kill the worker's process."""
    with (folder / job.student).open("a") as tries:
        tries.write("x")
    if job.student == "always" or (job.student == "once" and (folder / job.student).read_text() == "x"):
        os._exit(9)
    return Outcome(passes(job))


def outcomes(crew: WorkerPool, students: list[str]) -> list[tuple[str, str, str]]:
    """Each outcome's student, status and reason, in order of the students."""
    found = []
    for student in students:
        while not crew.has_room:
            found += crew.wait()
        crew.submit(job(student))
    while crew.is_busy:
        found += crew.wait()
    crew.close()
    return sorted((done.student, outcome.grade.status, outcome.grade.reason) for done, outcome in found)


def test_a_job_that_kills_its_worker_is_not_graded_and_takes_no_other_with_it(tmp_path: Path) -> None:
    crew = WorkerPool(Workers(new_pool, max_unfinished=2), partial(grade_or_die, tmp_path))
    students = ["always", "anna", "bert", "carl", "once"]
    found = outcomes(crew, students)
    assert [student for student, _, _ in found] == students
    assert [status for _, status, _ in found] == ["not graded", *["graded"] * 4]
    assert "lost twice" in found[0][2]
    assert (tmp_path / "always").read_text() in ("x", "xx")  # a pool may break before it has started the job
    assert (tmp_path / "once").read_text() == "xx"


def test_an_executor_that_cannot_be_opened_is_an_error_and_no_grade() -> None:
    def unavailable() -> Executor:
        raise OSError("no processes left")

    with pytest.raises(OSError, match="no processes left"):
        outcomes(WorkerPool(Workers(unavailable, max_unfinished=1), partial(grade_or_die, Path())), ["anna"])


def test_an_ungraded_job_is_repeated_alone_at_the_end() -> None:
    running, beside, tries = set[str](), dict[str, int](), Counter[str]()

    def busy_at_first(job: GradingJob) -> Outcome:
        running.add(job.student)
        tries[job.student] += 1
        beside[job.student] = len(running) - 1
        busy = job.student == "always" or (job.student == "at first" and tries[job.student] == 1)
        grade = (
            Grade(job.exercise, job.student, "", reason="the machine was too busy") if busy else passes(job)
        )
        running.remove(job.student)
        return Outcome(grade, retry_may_succeed=busy)

    retry_later: list[str] = []
    crew = WorkerPool(threads(3), busy_at_first, lambda job, outcome: retry_later.append(job.student))
    found = outcomes(crew, ["always", "anna", "at first", "bert"])
    assert [status for _, status, _ in found] == ["not graded", "graded", "graded", "graded"]
    assert sorted(retry_later) == ["always", "at first"]
    assert tries == {"always": 2, "anna": 1, "at first": 2, "bert": 1}
    assert beside["always"] == beside["at first"] == 0


def test_a_job_that_is_ungraded_for_a_permanent_reason_is_not_repeated() -> None:
    tries: list[str] = []

    def without_isolation(job: GradingJob) -> Outcome:
        tries.append(job.student)
        return Outcome(Grade(job.exercise, job.student, "", reason="the worker has no isolation"))

    ((_, status, _),) = outcomes(WorkerPool(threads(1), without_isolation), ["anna"])
    assert status == "not graded"
    assert tries == ["anna"]
