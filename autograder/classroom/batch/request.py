"""The options of a batch."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from autograder.classroom.batch.shards import Shard
from autograder.classroom.dates import Deadlines
from ros_runtime.course_error import CourseError


@dataclass(frozen=True)
class BatchRequest:
    """What to grade, how, and where the results go.

    Attributes:
        submitted: the folder of submissions.
        out: the output folder.
        jobs: how many arenas run in parallel on this machine.
        resume: keep the grades of an earlier run.
        seed: draws the inputs of hidden checks; None: the seed of the batch that is continued, or a new one.
        seed_per_student: draw different inputs for each student.
        students, exercises: grade only these, and keep the grades of the others. Empty: all.
        shard: the part of the class to grade here.
        dask: address of a scheduler whose workers grade.
        json_file: a second file for all verdicts.
        watch: keep grading new submissions until Ctrl-C.
        record: keep an MCAP file of each scenario.
        deadlines: due times and what late work costs; None: nothing is late.
    """

    submitted: Path
    out: Path
    jobs: int = 1
    resume: bool = False
    seed: int | None = None
    seed_per_student: bool = False
    students: tuple[str, ...] = ()
    exercises: tuple[str, ...] = ()
    shard: Shard | None = None
    dask: str | None = None
    json_file: Path | None = None
    watch: bool = False
    record: bool = False
    deadlines: Deadlines | None = None

    def __post_init__(self) -> None:
        if self.shard and (self.students or self.exercises or self.json_file):
            raise CourseError(
                "--shard grades a part of the whole class: leave out --student, --exercise and --json"
            )
        if self.shard and self.watch:
            raise CourseError(
                "--watch grades new submissions, and --shard a part of the present ones: give only one option"
            )

    @property
    def keeps_others(self) -> bool:
        """Whether submissions that are not graded now keep the grades they have."""
        return self.watch or bool(self.students or self.exercises)

    @property
    def continues_batch(self) -> bool:
        """Whether this continues the batch that `out` holds, with its seed."""
        return self.resume or self.keeps_others

    def selects(self, student: str, exercise: str) -> bool:
        """Whether a submission is among those to grade."""
        return (not self.students or student in self.students) and (
            not self.exercises or exercise in self.exercises
        )
