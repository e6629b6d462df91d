"""Splits a class into shards, each graded on its own machine, and merges them without gaps or duplicates."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

from pydantic import AfterValidator, TypeAdapter
from typing_extensions import TypedDict

from autograder.atomic_file import write_atomically
from autograder.classroom.batch.collection import Work
from autograder.classroom.batch.records import UNREADABLE
from autograder.classroom.batch.runner import Graded
from autograder.classroom.batch.seeds import Seeds
from autograder.classroom.batch.version import checks_version
from autograder.engine.exercise import exercises_folder
from autograder.engine.verdict import Grade
from ros_runtime.course_error import CourseError

SHARD = "shard.json"


@dataclass(frozen=True)
class Shard:
    """Part `number` (from 1) of a class that is split into `total` parts."""

    number: int
    total: int

    @classmethod
    def parse(cls, text: str) -> Shard:
        """Read "K/N"; raises CourseError unless 1 ≤ K ≤ N."""
        match = re.fullmatch(r"([1-9]\d{0,5})/([1-9]\d{0,5})", text)
        if not match or int(match[1]) > int(match[2]):
            raise CourseError(f"{text[:100]!r} is not a shard; expected K/N with K from 1 to N, such as 1/4")
        return cls(int(match[1]), int(match[2]))

    def part(self, works: Sequence[Work]) -> list[Work]:
        """Return this part of the class: every N-th submission of each exercise, the same on every machine."""
        in_order = sorted(works, key=lambda work: (work.exercise, work.student))
        return in_order[self.number - 1 :: self.total]


def write_shard(
    folder: Path, shard: Shard, seeds: Seeds, works: Sequence[Work], results: Sequence[Graded]
) -> None:
    """Write the input of a merge: the shard's grades and sources, and the list of the whole class's submissions."""
    exercises = sorted({work.exercise for work in works})
    record = {
        "shard": f"{shard.number}/{shard.total}",
        "seed": [seeds.batch, seeds.per_student, seeds.per_submission],
        "versions": {name: checks_version(exercises_folder() / name) for name in exercises},
        "submissions": [[work.student, work.exercise] for work in works],
        "graded": [
            {
                "grade": result.grade.to_json(),
                "sources": None if result.sources is None else dict(result.sources),
                "problem": result.problem,
                "timestamp": result.work.timestamp,
                "secret": result.work.secret,
            }
            for result in results
        ],
    }
    write_atomically(folder / SHARD, json.dumps(record) + "\n")


def _text(value: Any) -> Any:
    """Accept any str; pydantic's own type refuses unpaired surrogates, which a message may quote."""
    if not isinstance(value, str):
        raise ValueError("expected a string")
    return value


_Text = Annotated[Any, AfterValidator(_text)]


class _Row(TypedDict):
    """One submission of a shard."""

    grade: Any
    sources: dict[_Text, _Text] | None
    problem: _Text
    timestamp: _Text
    secret: _Text


class _Record(TypedDict):
    """The content of a shard's file."""

    shard: str
    seed: list[int]
    versions: dict[str, str]
    submissions: list[tuple[str, str]]
    graded: list[_Row]


_RECORD = TypeAdapter(_Record)


@dataclass(frozen=True)
class Merged:
    """The results of all shards in order of student and exercise, and a sentence on each missing result."""

    results: Sequence[Graded]
    missing: Sequence[str]


def merge_shards(folders: Sequence[Path]) -> Merged:
    """Merge the files that `write_shard` wrote into these folders.

    Raises:
        CourseError: a folder holds no shard, two folders hold the same submission, or the seeds, versions or isolations
            of the shards differ.
    """
    shards = {folder: _read(folder) for folder in folders}
    (first, given), *others = shards.items()
    for folder, record in others:
        for what, advice in (
            ("seed", "grade all shards with one --seed, and all or none with --seed-per-student"),
            ("versions", "bring all clones to one commit and grade with --resume"),
        ):
            if record[what] != given[what]:  # type: ignore[literal-required]
                raise CourseError(f"{first} and {folder} were graded with different {what}: {advice}")
    results: dict[tuple[str, str], Graded] = {}
    found_in: dict[tuple[str, str], Path] = {}
    isolations: dict[bool, Path] = {}
    for folder, record in shards.items():
        for row in record["graded"]:
            grade = _grade_of(row, folder)
            key = (grade.student, grade.exercise)
            if key in results:
                raise CourseError(
                    f"{grade.student}'s {grade.exercise} is in {found_in[key]} and in {folder}: leave out one of these"
                )
            # Essays and submissions of lost workers have another label.
            if grade.isolation in ("namespaces", "another-user", "untrusted"):
                isolations.setdefault(grade.isolation != "namespaces", folder)
            found_in[key] = folder
            results[key] = Graded(_work_of(row, grade), grade, row["sources"], row["problem"])
    if len(isolations) == 2:
        raise CourseError(
            f"{isolations[True]} was graded without isolation and hidden checks, {isolations[False]} with both: "
            "grade the first again where namespaces work"
        )
    return Merged([results[key] for key in sorted(results)], _missing(shards, set(results)))


def _work_of(row: _Row, grade: Grade) -> Work:
    return Work(grade.student, grade.exercise, (), row["timestamp"], row["secret"])


def _grade_of(row: _Row, folder: Path) -> Grade:
    try:
        return Grade.from_json(row["grade"])
    except ValueError as error:
        raise CourseError(
            f"{folder} contains an invalid grade ({str(error)[:500]}); grade this shard again"
        ) from error


def _missing(shards: Mapping[Path, _Record], found: set[tuple[str, str]]) -> list[str]:
    expected = {
        (student, exercise) for record in shards.values() for student, exercise in record["submissions"]
    }
    present = {record["shard"] for record in shards.values()}
    wanted = {f"{k}/{shard.total}" for shard in map(Shard.parse, present) for k in range(1, shard.total + 1)}
    sentences = [f"shard {name} is not among the folders" for name in sorted(wanted - present)]
    return sentences + [
        f"{student}'s {exercise} has no grade" for student, exercise in sorted(expected - found)
    ]


def _read(folder: Path) -> _Record:
    try:
        record = _RECORD.validate_python(json.loads((folder / SHARD).read_text(encoding="utf-8")))
        Shard.parse(record["shard"])
        return record
    except (*UNREADABLE, CourseError) as error:
        raise CourseError(
            f"{folder} holds no finished shard (`course grade --shard K/N`): {str(error)[:500]}"
        ) from error
