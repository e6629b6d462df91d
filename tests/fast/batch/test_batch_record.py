"""batch.json holds what was graded when, with which checks and at what cost, and can be read back."""

from __future__ import annotations

import hashlib
import json
from dataclasses import replace

import pytest
from rich.console import Console

from autograder.classroom.batch.batch_record import BATCH, BatchRecord, merged_record, read_batch, write_batch
from autograder.classroom.batch.collection import Work
from autograder.classroom.batch.job import Effort
from autograder.classroom.batch.runner import Graded
from autograder.classroom.batch.version import checks_version
from autograder.classroom.class_grading.output import print_changed_checks
from autograder.engine.exercise import exercises_folder
from autograder.engine.verdict import CheckVerdict, Grade

BEGUN = BatchRecord(
    "running",
    "2026-03-01T12:00:00+00:00",
    77,
    False,
    False,
    "namespaces",
    2,
    left_aside=["a file"],
    refused=["a folder"],
)
PROGRAM = {"battery_service.py": "x = 1\n"}


def result(student, host="one", status="passed", seconds=20.5):
    grade = Grade(
        "battery_service", student, "namespaces", [CheckVerdict("id", "title", status, 1, 2)], seed=77
    )
    effort = Effort("2026-03-01T12:00:01+00:00", "2026-03-01T12:00:41+00:00", host, seconds, 2, 9)
    return Graded(
        Work(student, "battery_service", (), "2026-02-28 08:00:00 UTC"), grade, PROGRAM, effort=effort
    )


def test_it_has_each_submission_with_its_evidence_and_the_sums(tmp_path):
    record = BEGUN.with_results([result("bert", "two", "error"), result("anna")]).closed("ended")
    write_batch(tmp_path, record)
    written = json.loads((tmp_path / BATCH).read_text())
    assert (written["state"], written["seed"], written["isolation"], written["jobs"]) == (
        "ended",
        77,
        "namespaces",
        2,
    )
    assert written["ended"] >= written["began"]
    assert written["counts"] == {"graded": 1, "not graded": 1}
    assert (written["processor_seconds"], written["arenas"], written["scenarios"]) == (41.0, 4, 18)
    assert (written["hosts"], written["host_count"]) == (["one", "two"], 2)
    assert (written["left_aside"], written["refused"]) == (["a file"], ["a folder"])
    anna, _ = written["submissions"]
    assert anna["student"] == "anna"
    assert anna["version"] == checks_version(exercises_folder() / "battery_service")
    assert anna["program"] == {
        "battery_service.py": hashlib.sha256(PROGRAM["battery_service.py"].encode()).hexdigest()
    }
    assert (anna["began"], anna["handed_in"]) == ("2026-03-01T12:00:01+00:00", "2026-02-28 08:00:00 UTC")
    assert read_batch(tmp_path) == record


def test_a_resumed_batch_says_which_exercises_are_graded_again():
    (row,) = BEGUN.with_results([result("anna")]).rows
    rows = [row, replace(row, exercise="walk_to"), replace(row, exercise="walk_client")]
    console = Console(record=True, width=200)
    works = [Work("anna", "battery_service"), Work("anna", "walk_to")]
    print_changed_checks(console, replace(BEGUN, rows=rows), works)
    assert "so these are graded again: walk_to; --exercise" in console.export_text()


def test_a_later_result_replaces_the_row_and_the_others_stay():
    record = BEGUN.with_results([result("anna"), result("bert")]).with_results([result("anna", "two")])
    assert [(row.student, row.host) for row in record.rows] == [("anna", "two"), ("bert", "one")]


def test_points_that_a_person_gives_are_in_it():
    (row,) = (
        BEGUN.with_results([result("anna")]).with_points([replace(result("anna").grade, reason="lost")]).rows
    )
    assert (row.status, row.score) == ("not graded", None)


@pytest.mark.parametrize(
    "content", ["", "{}", "[1]", '{"state": "ended", "submissions": [{"student": "anna"}]}']
)
def test_a_file_that_is_not_a_record_is_read_as_none(tmp_path, content):
    (tmp_path / BATCH).write_text(content)
    assert read_batch(tmp_path) is None


def test_shards_are_merged_into_one_record_unless_one_is_missing(tmp_path):
    folders = [tmp_path / "1", tmp_path / "2"]
    for folder, student in zip(folders, ("anna", "bert"), strict=True):
        write_batch(
            folder, replace(BEGUN, shard="1/2").with_results([result(student, student)]).closed("ended")
        )
    merged = merged_record(folders)
    assert merged
    assert [row.student for row in merged.rows] == merged.hosts == ["anna", "bert"]
    assert (merged.state, merged.shard, merged.jobs) == ("ended", "", 4)
    assert merged_record([*folders, tmp_path / "3"]) is None
