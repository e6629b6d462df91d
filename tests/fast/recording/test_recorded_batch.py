"""Recordings are returned with the outcome of a job, from any worker, and stored in the folder of the batch."""

from __future__ import annotations

import json
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from autograder.classroom.batch import job as module
from autograder.classroom.batch import runner as runner_module
from autograder.classroom.batch.cache import GradeCache
from autograder.classroom.batch.collection import Work
from autograder.classroom.batch.job import GradingJob, Outcome
from autograder.classroom.batch.runner import BatchRunner
from autograder.classroom.batch.worker_pool import Workers
from autograder.engine.grading import GradingOptions, Watcher
from autograder.engine.verdict import Grade
from autograder.isolation.arena_process import Kind
from autograder.isolation.availability import Isolation
from autograder.recording.kept import FOLDER
from autograder.recording.replay.recording import Recording
from course_cli.app import app
from falls import exercise, judged, walk
from student_work import work_at

ISOLATED = Isolation(Kind.NAMESPACES, "as a test says")
asked: list[bool] = []


def judge_a_fall(submission: Any, of: Any, options: GradingOptions, watcher: Watcher, **_: Any) -> Grade:
    """Stands for the arenas: every submission lets the robot fall in the scenario "walk"."""
    asked.append(options.recorded)
    verdicts = [judged(each, run) for run in [walk()] for each in of.checks]
    for verdict in verdicts:
        watcher.on_evidence(verdict, [walk()])
    return Grade(of.name, submission.student, ISOLATED.label, verdicts, seed=0)


@pytest.fixture
def works(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> list[Work]:
    monkeypatch.setattr(module, "grade", judge_a_fall)
    for each in (module, runner_module):
        monkeypatch.setattr(each, "load_exercise", lambda name, hidden: exercise())
        monkeypatch.setattr(each, "checks_version", lambda folder: "1")
    monkeypatch.setattr("autograder.classroom.batch.cache.checks_version", lambda folder: "1")
    monkeypatch.setattr(module, "available_isolation", lambda: ISOLATED)
    asked.clear()
    for student in ("anna", "bert"):
        (tmp_path / f"{student}.py").write_text(f"# {student}")
    return [work_at(tmp_path / f"{student}.py", student, "walk_to") for student in ("anna", "bert")]


def batch(tmp_path: Path, recordings: Path | None, **options: Any) -> BatchRunner:
    cache = GradeCache(tmp_path / "cache", ISOLATED)
    return BatchRunner(cache, ISOLATED, jobs=1, recordings=recordings, **options)


@pytest.mark.parametrize("share_memory", [True, False])
def test_each_submission_has_its_recordings_also_from_other_machines(
    share_memory: bool, tmp_path: Path, works: list[Work]
) -> None:
    workers = Workers(lambda: ThreadPoolExecutor(2), 2, share_memory)
    list(batch(tmp_path, tmp_path / FOLDER, workers=workers).run(works))
    for student in ("anna", "bert"):
        recording = Recording.read(tmp_path / FOLDER / student / "walk_to" / "walk.mcap")
        assert recording.about["student"] == student
        assert recording.first_failed
        assert recording.first_failed.check == "stays_up"
    assert asked == [True, True]


def test_without_the_option_no_recording_is_made(tmp_path: Path, works: list[Work]) -> None:
    list(batch(tmp_path, None).run(works))
    assert asked == [False, False]
    assert not list(tmp_path.rglob("*.mcap"))


def test_a_failed_recording_costs_no_grade(
    tmp_path: Path, works: list[Work], monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(*arguments: Any) -> bytes:
        raise OSError("no memory left")

    monkeypatch.setattr("autograder.recording.recorder.mcap_file", broken)
    results = list(batch(tmp_path, tmp_path / FOLDER).run(works))
    assert [result.grade.score for result in results] == [1, 1]
    assert not list(tmp_path.rglob("*.mcap"))


def test_a_grade_of_an_earlier_run_keeps_its_recording(tmp_path: Path, works: list[Work]) -> None:
    list(batch(tmp_path, tmp_path / FOLDER).run(works))
    before = {path: path.stat().st_mtime_ns for path in tmp_path.rglob("*.mcap")}
    assert len(before) == 2
    assert all(result.cached for result in batch(tmp_path, tmp_path / FOLDER, resume=True).run(works))
    assert {path: path.stat().st_mtime_ns for path in tmp_path.rglob("*.mcap")} == before


def test_an_outcome_can_be_sent_to_another_machine() -> None:
    import pickle

    job = GradingJob("anna", "walk_to", {}, 0, True, "1", recorded=True)
    outcome = Outcome(Grade("walk_to", "anna", "namespaces"), recordings={"walk.mcap": b"\x89MCAP"})
    assert pickle.loads(pickle.dumps(job)).recorded
    assert pickle.loads(pickle.dumps(outcome)).recordings == {"walk.mcap": b"\x89MCAP"}


def test_a_merge_says_where_the_recordings_of_its_shards_are(tmp_path: Path) -> None:
    shard = {"shard": "1/1", "seed": [0, False], "versions": {}, "submissions": [], "graded": []}
    folder = tmp_path / "one"
    (folder / FOLDER).mkdir(parents=True)
    (folder / "shard.json").write_text(json.dumps(shard))
    ran = CliRunner().invoke(
        app("merge"), ["merge", str(folder), "--out", str(tmp_path / "all")], env={"COLUMNS": "400"}
    )
    assert f"recordings are not merged; they stay in {folder / FOLDER}" in " ".join(ran.output.split())
