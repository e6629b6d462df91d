"""Jobs on a Dask cluster of two processes, one of which is killed during a job."""

from __future__ import annotations

import os
import signal
from functools import partial
from pathlib import Path

import pytest
from distributed import LocalCluster

from autograder.classroom.batch import dask_workers as module
from autograder.classroom.batch.dask_workers import dask_cluster
from autograder.classroom.batch.job import GradingJob, Outcome, carry_out
from autograder.classroom.batch.worker_pool import WorkerPool
from autograder.engine.verdict import CheckVerdict, Grade
from autograder.isolation.arena_process import Kind
from autograder.isolation.availability import Isolation
from ros_runtime.course_error import CommandFailed

STUDENTS = [f"student{number:02}" for number in range(20)]


def job(student: str, trusted: bool = False) -> GradingJob:
    return GradingJob(student, "battery_service", {"battery_service.py": ""}, 0, trusted, "version")


def grade_once_the_killed_is_gone(folder: Path, job: GradingJob) -> Outcome:
    """Report the process of a job, and block the first job of each process until one process was killed."""
    (folder / "workers" / str(os.getpid())).touch()
    while not (folder / "killed").exists():
        pass
    verdicts = [CheckVerdict("id", "title", "passed", 1, 1)]
    return Outcome(Grade(job.exercise, job.student, "untrusted", verdicts))


def test_with_a_killed_worker_no_grade_is_lost_or_duplicated(tmp_path, monkeypatch):
    monkeypatch.setenv("COURSE_ISOLATION", "none")
    (tmp_path / "workers").mkdir()
    with (
        LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as local,
        dask_cluster(local.scheduler_address) as cluster,
    ):
        assert (cluster.size, cluster.isolation.label, cluster.left_out) == (2, "untrusted", ())
        crew = WorkerPool(cluster.workers, partial(grade_once_the_killed_is_gone, tmp_path))
        for student in STUDENTS:
            crew.submit(job(student))
        while len(working := list((tmp_path / "workers").iterdir())) < 2:
            pass
        os.kill(int(working[0].name), signal.SIGKILL)
        (tmp_path / "killed").touch()
        found = []
        while crew.is_busy:
            found += crew.wait()
        crew.close()
    assert sorted(each.student for each, _ in found) == STUDENTS
    assert {outcome.grade.status for _, outcome in found} == {"graded"}


def test_a_worker_without_isolation_skips_hidden_checks_and_reports_it(monkeypatch):
    monkeypatch.setenv("COURSE_ISOLATION", "none")
    outcome = carry_out(job("anna", trusted=True))
    assert (outcome.grade.status, outcome.grade.isolation) == ("not graded", "untrusted")
    assert "which hidden checks need" in outcome.grade.reason


def test_a_worker_with_other_checks_does_not_grade(monkeypatch):
    monkeypatch.setenv("COURSE_ISOLATION", "none")
    outcome = carry_out(job("anna"))
    assert outcome.grade.status == "not graded"
    assert "other checks or another engine" in outcome.grade.reason


def test_only_isolated_workers_are_chosen_where_there_are_any():
    isolated, open_ = Isolation(Kind.NAMESPACES, "tried"), Isolation(Kind.NONE, "no bubblewrap")
    cluster = module._cluster(object(), {"tcp://a": open_, "tcp://b": isolated})
    assert (cluster.size, cluster.isolation) == (1, isolated)
    assert "tcp://a has no isolation and gets no jobs: no bubblewrap" in cluster.left_out[0]


def test_an_absent_scheduler_or_package_says_what_to_do(monkeypatch):
    monkeypatch.setattr(module, "_CONNECT_TIMEOUT", 0.5)
    with pytest.raises(CommandFailed, match="dask scheduler"), dask_cluster("tcp://127.0.0.1:1"):
        pass
    monkeypatch.setitem(__import__("sys").modules, "distributed", None)
    with (
        pytest.raises(CommandFailed, match=r"pip install .* dask distributed"),
        dask_cluster("tcp://127.0.0.1:1"),
    ):
        pass
