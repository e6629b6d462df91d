"""Readers return a value or a reason, whatever a student sends; errors that fuzzers found have tests here."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest

pytest.importorskip("rclpy")

from autograder.classroom.batch.collection import collect
from autograder.classroom.batch.records import GRADES, read_grades
from autograder.classroom.batch.shards import SHARD, merge_shards
from autograder.classroom.pages.drawings import Drawings
from autograder.engine.arena_run import NotGraded, read_events
from autograder.engine.submission import UnusableSubmission
from autograder.engine.verdict import Grade
from fuzz.fuzzer import LONG, SUITE
from fuzz.readers import records
from fuzz.readers.all import CHANNELS, READERS
from ros_runtime.course_error import CourseError
from student_work import work_at

IN_ARENAS = ("answers-judged",)  # reads all recorded runs, which takes seconds; so it is in tests/arena/fuzz


@pytest.mark.parametrize("name", [name for name in READERS if name not in IN_ARENAS])
def test_the_fuzzer_finds_no_error(name: str, pytestconfig: pytest.Config) -> None:
    READERS[name].run(LONG if pytestconfig.getoption("long_fuzz") else SUITE)


def test_every_channel_has_a_fuzzer() -> None:
    assert {fuzzer.channel for fuzzer in READERS.values()} == set(CHANNELS)


@pytest.mark.parametrize(
    "line",
    [
        b"[" * 100_000,
        b'{"t": 1, "kind": []}',
        b'{"t": 1, "kind": {"a": 1}}',
        b'{"t": 1, "kind": "node_output", "text": {"ros_type": "std_msgs/msg/Float64", "ros_fields": {"data": 1'
        + b"0" * 400
        + b"}}}",
    ],
    ids=["brackets", "a list for a kind", "an object for a kind", "a number that no field holds"],
)
def test_an_unreadable_report_gives_no_grade(line: bytes) -> None:
    with pytest.raises(NotGraded, match="cannot be read"):
        read_events(line + b"\n")


def test_the_folder_of_another_student_is_not_read_through_a_link(tmp_path: Path) -> None:
    theirs = tmp_path / "zoe/battery_service"
    theirs.mkdir(parents=True)
    (theirs / "battery_service.py").write_text("zoe's work")
    (tmp_path / "anna").mkdir()
    (tmp_path / "anna/battery_service").symlink_to(theirs)
    annas, zoes = collect(tmp_path).works
    with pytest.raises(UnusableSubmission, match="is a link; hand in the folder itself"):
        annas.read()
    assert zoes.read().sources == {"battery_service.py": "zoe's work"}


@pytest.mark.parametrize("name", ["battery_service.ipynb", "battery_service.py"])
def test_a_folder_in_the_place_of_a_file_is_reported(tmp_path: Path, name: str) -> None:
    (tmp_path / "anna" / name).mkdir(parents=True)
    (work,) = collect(tmp_path).works
    with pytest.raises(UnusableSubmission, match="is not an ordinary file"):
        work.read()


def test_an_unreadable_file_is_reported(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "battery_service.py"
    path.write_text("pass")

    def refuse(*_: object, **__: object) -> bytes:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "read_bytes", refuse)
    with pytest.raises(UnusableSubmission, match=r"battery_service\.py cannot be read: Permission denied"):
        work_at(path, "anna", "battery_service").read()


@pytest.mark.skipif(os.geteuid() == 0, reason="root may read every folder")
def test_an_unreadable_folder_costs_no_other_student_a_grade(tmp_path: Path) -> None:
    for student in ("anna", "zoe"):
        (tmp_path / student).mkdir()
        (tmp_path / student / "battery_service.py").write_text("pass")
    (tmp_path / "anna").chmod(0)
    try:
        collection = collect(tmp_path)
    finally:
        (tmp_path / "anna").chmod(0o755)
    assert [work.student for work in collection.works] == ["zoe"]
    assert "'anna' cannot be read: Permission denied" in collection.refused[0]


GRADE = records._GRADE.to_json()


@pytest.mark.parametrize("content", ["", "{", "7", "[null]", json.dumps([GRADE | {"checks": None}])])
def test_a_damaged_file_of_grades_says_what_to_do(tmp_path: Path, content: str) -> None:
    (tmp_path / GRADES).write_text(content)
    with pytest.raises(CourseError, match="restore the file of the last batch"):
        read_grades(tmp_path / GRADES)


@pytest.mark.parametrize("points", [3, -1, float("nan")])
def test_no_grade_has_impossible_points(points: float) -> None:
    check = GRADE["checks"][0] | {"points": points}
    with pytest.raises(ValueError, match="points"):
        Grade.from_json(GRADE | {"checks": [check]})


@pytest.mark.parametrize(
    "change", [{"shard": None}, {"shard": "3/2"}, {"graded": [1]}, {"graded": {}}, {"submissions": [["a"]]}]
)
def test_a_damaged_shard_is_refused(tmp_path: Path, change: dict[str, object]) -> None:
    record = json.loads(records._SHARDS[0]) | change
    (tmp_path / SHARD).write_text(json.dumps(record))
    with pytest.raises(CourseError, match=r"(holds no finished shard|contains an invalid grade)"):
        merge_shards([tmp_path])


def test_a_shard_with_a_lone_surrogate_is_merged(tmp_path: Path) -> None:
    record = json.loads(records._SHARDS[0])
    record["graded"][0]["problem"] = "\ud800"
    (tmp_path / SHARD).write_text(json.dumps(record))
    assert next(result.problem for result in merge_shards([tmp_path]).results) == "\ud800"


def test_a_shard_with_an_impossible_grade_is_refused(tmp_path: Path) -> None:
    record = json.loads(records._SHARDS[0])
    record["graded"][0]["grade"]["checks"][0]["points"] = 100
    (tmp_path / SHARD).write_text(json.dumps(record))
    with pytest.raises(CourseError, match="grade this shard again"):
        merge_shards([tmp_path])


@pytest.mark.parametrize("content", [b"", b"[" * 100_000, b'[null, "<svg/>"]', b"{}", b"\xff"])
def test_damaged_drawings_and_a_damaged_cache_are_ignored(content: bytes) -> None:
    records.require_cached_or_none(content)
    records.require_drawings_or_none(content)


def test_valid_drawings_are_read(tmp_path: Path) -> None:
    drawings, failed = Drawings(tmp_path), records._GRADE.checks[1]
    drawings.keep("battery_service", {}, failed, ["<svg/>"])
    assert drawings.of(records._GRADE, {}) == {"b": ["<svg/>"]}
