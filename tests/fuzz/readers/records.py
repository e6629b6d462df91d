"""Files that batches write and read again, damaged: grades, shards, caches, drawings."""

from __future__ import annotations

import json
import tempfile
from collections.abc import Callable
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

from hypothesis import strategies as st

from autograder.classroom.batch.batch_record import BATCH, BatchRecord, Row, read_batch
from autograder.classroom.batch.cache import CachedGrade, GradeCache
from autograder.classroom.batch.collection import Work
from autograder.classroom.batch.job import Effort
from autograder.classroom.batch.records import GRADES, read_grades
from autograder.classroom.batch.runner import Graded
from autograder.classroom.batch.seeds import Seeds
from autograder.classroom.batch.shards import SHARD, Shard, merge_shards, write_shard
from autograder.classroom.pages.drawings import Drawings
from autograder.engine.exercise import load_exercise
from autograder.engine.submission import Submission
from autograder.engine.verdict import CheckVerdict, Grade
from autograder.isolation.arena_spec import Kind
from autograder.isolation.availability import Isolation
from autograder.report.table import class_table
from fuzz import strategies as odd
from fuzz.fuzzer import Fuzzer
from ros_runtime.course_error import CourseError

EXERCISE = "battery_service"
ISOLATION = Isolation(Kind.NAMESPACES, "")
LONGEST_REASON = 5000  # characters


def require_grades_or_reason(data: bytes) -> None:
    """Require that a file of grades is read, or refused with a sentence."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, GRADES)
        path.write_bytes(data)
        try:
            grades = read_grades(path)
        except CourseError as error:
            assert len(str(error)) < LONGEST_REASON
            return
    for grade in grades:
        _require_no_more_than_full(grade)
    class_table(grades)


def require_merged_or_reason(data: bytes) -> None:
    """Require that two shards of which one is damaged are merged, or refused with a sentence."""
    with tempfile.TemporaryDirectory() as folder:
        first, second = Path(folder, "first"), Path(folder, "second")
        for place, content in ((first, _SHARDS[0]), (second, data)):
            place.mkdir()
            (place / SHARD).write_bytes(content)
        try:
            merged = merge_shards([first, second])
        except CourseError as error:
            assert len(str(error)) < LONGEST_REASON
            return
    for result in merged.results:
        _require_no_more_than_full(result.grade)
        assert result.sources is None or all(isinstance(text, str) for text in result.sources.values())
    class_table([result.grade for result in merged.results])


def require_cached_or_none(data: bytes) -> None:
    """Require that a damaged cache returns no grade that was never given, and raises nothing."""
    exercise = load_exercise(EXERCISE, hidden=False)
    submission = Submission(EXERCISE, "anna", {f"{EXERCISE}.py": "pass"})
    with tempfile.TemporaryDirectory() as folder:
        cache = GradeCache(Path(folder), ISOLATION)
        cache.put(submission, exercise, 0, CachedGrade(_GRADE, _EFFORT))
        (path,) = Path(folder).rglob("*.json")
        path.write_bytes(data)
        known = cache.get(submission, exercise, 0)
    if known is not None:
        assert known.grade.student == "anna"
        assert known.grade.exercise == EXERCISE
        assert known.grade.status == "graded"
        _require_no_more_than_full(known.grade)
        assert isinstance(known.effort.processor_seconds, float)


def require_batch_or_none(data: bytes) -> None:
    """Require that a damaged record reads as None or can still be shown on the class page."""
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, BATCH).write_bytes(data)
        record = read_batch(Path(folder))
    if record is not None:
        assert all(isinstance(words, str) for words in record.in_words().values())


def require_drawings_or_none(data: bytes) -> None:
    """Require that damaged drawings are read as none."""
    failed = CheckVerdict("id", "title", "failed", 0, 1)
    with tempfile.TemporaryDirectory() as folder:
        drawings = Drawings(Path(folder))
        drawings.keep(EXERCISE, {}, failed, ["<svg/>"])
        (path,) = Path(folder).rglob("*.json")
        path.write_bytes(data)
        found = drawings.of(Grade(EXERCISE, "anna", "namespaces", [failed]), {})
    assert all(isinstance(svg, str) for svgs in found.values() for svg in svgs)


def _require_no_more_than_full(grade: Grade) -> None:
    """Require a score between 0 and the maximum."""
    assert grade.status in ("graded", "not graded", "to mark")
    if grade.score is not None:
        assert 0 <= grade.score <= grade.max_score


def _shard(number: int) -> bytes:
    works = [Work(name, EXERCISE) for name in ("anna", "bert", "zoe", "zora")]
    shard = Shard(number, 2)
    graded = [
        Graded(work, replace(_GRADE, student=work.student), {f"{EXERCISE}.py": "pass"})
        for work in shard.part(works)
    ]
    with tempfile.TemporaryDirectory() as folder:
        write_shard(Path(folder), shard, Seeds(0), works, graded)
        return Path(folder, SHARD).read_bytes()


_CHECKS = [
    CheckVerdict("a", "A", "passed", 1, 1),
    CheckVerdict("b", "B", "failed", 0, 2, "x", "y", "z", 1.5, "log", True),
]
_GRADE = Grade(EXERCISE, "anna", "namespaces", _CHECKS, seed=0)
_EFFORT = Effort("2026-01-01T10:00:00Z", "2026-01-01T10:00:20Z", "here", 7.5, 1, 9)
_CACHED = {"grade": _GRADE.to_json(), "effort": asdict(_EFFORT)}
_BATCH = BatchRecord(
    state="ended",
    began=_EFFORT.began,
    seed=7,
    seed_per_student=False,
    seed_per_submission=False,
    isolation="namespaces",
    jobs=2,
    rows=[Row("anna", EXERCISE, "graded", 1, 3, 7, "namespaces", "0" * 64, {}, **asdict(_EFFORT))],
)
_SHARDS = [_shard(1), _shard(2)]


def _damaged(sample: Any) -> st.SearchStrategy[bytes]:
    data = json.dumps(sample).encode()
    return st.one_of(
        odd.damaged_json([sample]).map(lambda value: json.dumps(value).encode()),
        odd.mutated([data]),
        odd.blobs,
    )


def _fuzzer(name: str, sample: Any, require: Callable[[bytes], None]) -> Fuzzer:
    return Fuzzer(f"records-{name}", "records", _damaged(sample), require, weight=2)


FUZZERS = (
    _fuzzer("grades", [_GRADE.to_json()] * 2, require_grades_or_reason),
    _fuzzer("shards", json.loads(_SHARDS[1]), require_merged_or_reason),
    _fuzzer("cache", _CACHED, require_cached_or_none),
    _fuzzer("batch", _BATCH.to_json(), require_batch_or_none),
    _fuzzer("drawings", ["<svg/>", "<svg/>"], require_drawings_or_none),
)
