"""batch.json: when, where and with which versions each submission was graded, so that a grade can be reproduced."""

from __future__ import annotations

import hashlib
import json
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any, Literal

from pydantic import TypeAdapter

from autograder.atomic_file import write_atomically
from autograder.classroom.batch.job import utc_now
from autograder.classroom.batch.records import UNREADABLE
from autograder.classroom.batch.runner import Graded
from autograder.classroom.batch.seeds import Seeds
from autograder.classroom.batch.version import checks_version
from autograder.engine.exercise import exercises_folder
from autograder.engine.verdict import Grade

BATCH = "batch.json"

State = Literal["running", "ended", "interrupted"]


@dataclass(frozen=True)
class Row:
    """One graded submission.

    Attributes:
        program: SHA-256 of each submitted file, by file name; empty if the submission could not be read.
        version: hash of the exercise's checks and the engine, as `batch.version` computes it.
        began, ended, host, processor_seconds, arenas, scenarios: of the run that produced the grade, even if that run
            was in an earlier batch; "" and 0 if the worker was lost.
    """

    student: str
    exercise: str
    status: str
    score: float | None
    max_score: int
    seed: int | None
    isolation: str
    version: str
    program: Mapping[str, str]
    handed_in: str = ""
    began: str = ""
    ended: str = ""
    host: str = ""
    processor_seconds: float = 0.0
    arenas: int = 0
    scenarios: int = 0

    @classmethod
    def of(cls, result: Graded) -> Row:
        """Return the row of a result."""
        grade, effort = result.grade, result.effort
        return cls(
            student=grade.student,
            exercise=grade.exercise,
            status=grade.status,
            score=grade.score,
            max_score=grade.max_score,
            seed=grade.seed,
            isolation=grade.isolation,
            version=checks_version(exercises_folder() / grade.exercise),
            program={
                name: hashlib.sha256(text.encode()).hexdigest()
                for name, text in (result.sources or {}).items()
            },
            handed_in=result.work.timestamp,
            **(asdict(effort) if effort else {}),
        )


@dataclass(frozen=True)
class BatchRecord:
    """A batch from its start to its end.

    Attributes:
        state: "running" stays in the file if the batch is killed.
        began, ended: start and end of the last run, UTC, ISO 8601; `ended` is None while the batch is running.
        seed, seed_per_student, seed_per_submission: see `Seeds`; they draw the inputs of hidden checks.
        isolation: the label of the isolation on the machine or the cluster.
        jobs: number of submissions that were graded in parallel.
        cluster: address of the Dask scheduler, or "".
        shard: "K/N", or "".
        toolkit: commit of the clone.
        course: commit of the exercises, if they are in another repository.
        rows: every submission that has a grade in the output folder, also from earlier runs.
        left_aside, refused: sentences on files and folders that were not graded.
    """

    state: State
    began: str
    seed: int
    seed_per_student: bool
    seed_per_submission: bool
    isolation: str
    jobs: int
    cluster: str = ""
    shard: str = ""
    toolkit: str = ""
    course: str = ""
    ended: str | None = None
    rows: Sequence[Row] = ()
    left_aside: Sequence[str] = ()
    refused: Sequence[str] = ()

    @property
    def seeds(self) -> Seeds:
        """The seeds of the batch."""
        return Seeds(self.seed, self.seed_per_student, self.seed_per_submission)

    @property
    def hosts(self) -> list[str]:
        """The machines that graded."""
        return sorted({row.host for row in self.rows if row.host})

    def with_results(self, results: Sequence[Graded]) -> BatchRecord:
        """Return the record with the rows of these results; they replace earlier rows of the same submissions."""
        rows = {(row.student, row.exercise): row for row in self.rows}
        rows |= {(row.student, row.exercise): row for row in map(Row.of, results)}
        return replace(self, rows=[rows[key] for key in sorted(rows)])

    def with_points(self, grades: Sequence[Grade]) -> BatchRecord:
        """Return the record with the status and score of these grades, such as points that a person gave an essay."""
        now = {(grade.student, grade.exercise): grade for grade in grades}
        rows = [
            replace(row, status=grade.status, score=grade.score)
            if (grade := now.get((row.student, row.exercise)))
            else row
            for row in self.rows
        ]
        return replace(self, rows=rows)

    def in_words(self) -> dict[str, str]:
        """Return the lines on the batch for the class page, by their labels."""
        seconds = sum(row.processor_seconds for row in self.rows)
        versions = sorted({f"{row.exercise} {row.version[:12]}" for row in self.rows})
        return {
            "last run": f"{self.began} to {self.ended or 'now'}",
            "seed of hidden checks": self.seeds.in_words(),
            "isolation": self.isolation,
            "machines": ", ".join(self.hosts) or "none",
            "processor time": f"{seconds:,.0f} s in {sum(row.arenas for row in self.rows):,} arenas",
            "toolkit": self.toolkit or "not in a git repository",
            **({"course": self.course} if self.course else {}),
            "checks and engine": ", ".join(versions),
        }

    def closed(self, state: State) -> BatchRecord:
        """Return the record of a batch that ends now."""
        return replace(self, state=state, ended=utc_now())

    def to_json(self) -> dict[str, Any]:
        """Return the record as JSON: the totals first, then the rows."""
        record = asdict(self)
        rows = record.pop("rows")
        sums = {
            "counts": dict(Counter(row.status for row in self.rows)),
            "processor_seconds": round(sum(row.processor_seconds for row in self.rows), 1),
            "arenas": sum(row.arenas for row in self.rows),
            "scenarios": sum(row.scenarios for row in self.rows),
            "hosts": self.hosts,
            "host_count": len(self.hosts),
            "versions": {row.exercise: row.version for row in self.rows},
        }
        return {**record, **sums, "submissions": rows}

    @classmethod
    def from_json(cls, record: Mapping[str, Any]) -> BatchRecord:
        """Read back what `to_json` returned; raises ValueError or KeyError for anything else."""
        return _RECORDS.validate_python({**record, "rows": record["submissions"]})


_RECORDS = TypeAdapter(BatchRecord)


def write_batch(folder: Path, record: BatchRecord) -> None:
    """Write batch.json atomically."""
    write_atomically(folder / BATCH, json.dumps(record.to_json(), indent=2) + "\n")


def read_batch(folder: Path) -> BatchRecord | None:
    """Read batch.json; None if it is missing or was written by another version."""
    try:
        return BatchRecord.from_json(json.loads((folder / BATCH).read_text(encoding="utf-8")))
    except (*UNREADABLE, TypeError, KeyError):
        return None


def merged_record(folders: Sequence[Path]) -> BatchRecord | None:
    """Return one record for all shards; None if a shard has no record."""
    records = [record for record in map(read_batch, folders) if record]
    if len(records) < len(folders):
        return None
    rows = {(row.student, row.exercise): row for record in records for row in record.rows}
    return replace(
        records[0],
        state="ended",
        began=min(record.began for record in records),
        ended=max(record.ended or "" for record in records) or None,
        jobs=sum(record.jobs for record in records),
        shard="",
        rows=[rows[key] for key in sorted(rows)],
        left_aside=sorted({line for record in records for line in record.left_aside}),
        refused=sorted({line for record in records for line in record.refused}),
    )
