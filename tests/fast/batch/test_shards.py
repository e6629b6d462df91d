"""Shards of a class contain each submission once, and a merge refuses shards of different batches."""

from __future__ import annotations

import json

import pytest

from autograder.classroom.batch.collection import Work
from autograder.classroom.batch.runner import Graded
from autograder.classroom.batch.seeds import ONE_FOR_ALL, Seeds
from autograder.classroom.batch.shards import SHARD, Shard, merge_shards, write_shard
from autograder.engine.verdict import CheckVerdict, Grade
from ros_runtime.course_error import CourseError

WORKS = [
    Work(f"student{number}", exercise, (), "2026-03-01 12:00:00 UTC")
    for number in range(5)
    for exercise in ("battery_service", "walk_to")
]


def graded(work, isolation="namespaces"):
    grade = Grade(
        work.exercise, work.student, isolation, [CheckVerdict("id", "title", "passed", 1, 1)], seed=0
    )
    return Graded(work, grade, {f"{work.exercise}.py": work.student})


def make(folder, number, of=3, seed=0, isolation="namespaces"):
    shard = Shard(number, of)
    write_shard(folder, shard, Seeds(seed), WORKS, [graded(work, isolation) for work in shard.part(WORKS)])
    return folder


@pytest.mark.parametrize("of", [1, 3, 10, 12])
def test_each_submission_is_in_one_shard_whatever_the_order(of):
    parts = [work for number in range(of) for work in Shard(number + 1, of).part(WORKS[::-1])]
    assert sorted(parts, key=str) == sorted(WORKS, key=str)
    assert Shard(1, of).part(WORKS) == Shard(1, of).part(WORKS[::-1])


@pytest.mark.parametrize(
    "text", ["0/3", "4/3", "1", "1/0", "a/b", "-1/3", "1/3/5", "1/1000000000", "9" * 5000 + "/9"]
)
def test_an_invalid_shard_is_refused(text):
    with pytest.raises(CourseError, match="expected K/N"):
        Shard.parse(text)


def test_the_merge_has_every_result_with_what_was_handed_in(tmp_path):
    folders = [make(tmp_path / str(number), number) for number in (3, 1, 2)]
    merged = merge_shards(folders)
    assert merged.missing == []
    assert [(each.grade.student, each.grade.exercise) for each in merged.results] == [
        (work.student, work.exercise) for work in WORKS
    ]
    assert merged.results == [graded(work) for work in WORKS]


def test_a_merge_says_which_shard_and_whose_work_is_missing(tmp_path):
    merged = merge_shards([make(tmp_path / "1", 1), make(tmp_path / "3", 3)])
    absent = Shard(2, 3).part(WORKS)
    assert merged.missing[0] == "shard 2/3 is not among the folders"
    assert {f"{work.student}'s {work.exercise} has no grade" for work in absent} == set(merged.missing[1:])


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"number": 1}, "is in .*leave out one of these"),
        ({"number": 2, "seed": 7}, "different seed"),
        ({"number": 2, "isolation": "untrusted"}, "without isolation"),
    ],
)
def test_shards_of_different_batches_are_refused(tmp_path, change, message):
    make(tmp_path / "a", 1)
    make(tmp_path / "b", **change)
    with pytest.raises(CourseError, match=message):
        merge_shards([tmp_path / "a", tmp_path / "b"])


def test_an_essay_stands_beside_grades_without_isolation(tmp_path):
    work = Work("zoe", "arm_architecture")
    write_shard(
        tmp_path,
        Shard(1, 1),
        ONE_FOR_ALL,
        [work, WORKS[0]],
        [graded(work, "by hand"), graded(WORKS[0], "untrusted")],
    )
    assert len(merge_shards([tmp_path]).results) == 2


def test_other_checks_are_refused_and_so_is_a_folder_without_a_shard(tmp_path):
    make(tmp_path / "a", 1)
    record = json.loads((make(tmp_path / "b", 2) / SHARD).read_text())
    (tmp_path / "b" / SHARD).write_text(json.dumps(record | {"versions": {"walk_to": "other"}}))
    with pytest.raises(CourseError, match="different versions: bring all clones to one commit"):
        merge_shards([tmp_path / "a", tmp_path / "b"])
    with pytest.raises(CourseError, match="holds no finished shard"):
        merge_shards([tmp_path / "a", tmp_path / "none"])
