"""Prepares a batch: locks its output folder, starts the workers, chooses the seeds and begins its record."""

from __future__ import annotations

from collections.abc import Generator, Iterable, Iterator, Sequence
from contextlib import closing, contextmanager, nullcontext
from dataclasses import dataclass, replace

from rich.console import Console

from autograder.classroom.batch.batch_record import BatchRecord, read_batch
from autograder.classroom.batch.cache import GradeCache
from autograder.classroom.batch.collection import Work
from autograder.classroom.batch.dask_workers import Cluster, dask_cluster
from autograder.classroom.batch.folder_lock import locked
from autograder.classroom.batch.job import BatchWatcher, utc_now
from autograder.classroom.batch.records import GRADES, read_grades
from autograder.classroom.batch.request import BatchRequest
from autograder.classroom.batch.runner import BatchRunner, Graded
from autograder.classroom.batch.seeds import Seeds, drawn_seed, seed_of_submissions
from autograder.classroom.batch.selection import require_seed
from autograder.classroom.batch.version import commit_of
from autograder.classroom.class_grading.progress import BatchProgress
from autograder.classroom.pages.drawings import Drawings
from autograder.engine.exercise import exercises_folder
from autograder.engine.path_exposure import require_hidden
from autograder.engine.verdict import Grade
from autograder.isolation.availability import Isolation, available_isolation
from autograder.recording.kept import FOLDER as RECORDINGS
from autograder.report.console import NOTICE
from ros_runtime.project import PROJECT


@dataclass(frozen=True)
class PreparedBatch:
    """A prepared batch.

    Attributes:
        before: grades in the output folder, kept for submissions that are not graded again.
        record: the batch's record when grading begins.
    """

    console: Console
    request: BatchRequest
    isolation: Isolation
    cluster: Cluster | None
    seeds: Seeds
    before: Sequence[Grade]
    record: BatchRecord

    def graded(self, works: Iterable[Work | None]) -> Generator[Graded, None, None]:
        """Yield each submission as soon as it is graded (`BatchRunner.run`), and show the progress."""
        request, cluster = self.request, self.cluster
        with BatchProgress(self.console, elsewhere=cluster.size if cluster else 0) as progress:
            runner = BatchRunner(
                GradeCache(request.out / "cache", self.isolation),
                self.isolation,
                jobs=request.jobs,
                seeds=self.seeds,
                resume=request.resume or request.watch,
                workers=cluster.workers if cluster else None,
                watcher=BatchWatcher(progress.verdict, progress.begin, progress.end, progress.retry_later),
                drawings=Drawings(request.out),
                recordings=request.out / RECORDINGS if request.record else None,
            )
            if isinstance(works, Sequence):
                progress.expect(sum(runner.count(work.exercise) for work in works if work), len(works))
            with closing(runner.run(works)) as graded:
                for result in graded:
                    progress.graded(result, runner.count(result.work.exercise))
                    yield result


@contextmanager
def prepared(console: Console, request: BatchRequest, works: Sequence[Work]) -> Iterator[PreparedBatch]:
    """Lock the output folder, start the workers and print their isolation.

    `works` are the submissions of the whole class.

    Raises:
        CourseError: another process grades into the output folder, students could read the checks on this machine,
            there is no cluster at the given address, or the stored grades have another seed or cannot be read.
    """
    # without isolation a submission can read every file anyway
    if not request.dask and available_isolation().trusted:
        require_hidden([exercises_folder(), request.submitted, request.out])
    with (
        locked(request.out),
        dask_cluster(request.dask) if request.dask else nullcontext() as cluster,
    ):
        record = read_batch(request.out)
        needs_grades = request.keeps_others or (request.continues_batch and not record)
        there = read_grades(request.out / GRADES) if needs_grades else []
        seeds = choose_seeds(request, record, there, works)
        before = there if request.keeps_others else []
        require_seed(before, seeds)
        isolation = cluster.isolation if cluster else available_isolation()
        _print_isolation(console, isolation, cluster)
        begun = BatchRecord(
            state="running",
            began=utc_now(),
            seed=seeds.batch,
            seed_per_student=seeds.per_student,
            seed_per_submission=seeds.per_submission,
            isolation=isolation.label,
            jobs=cluster.size if cluster else request.jobs,
            cluster=request.dask or "",
            shard=f"{request.shard.number}/{request.shard.total}" if request.shard else "",
            toolkit=commit_of(PROJECT),
            course="" if exercises_folder().is_relative_to(PROJECT) else commit_of(exercises_folder()),
            rows=record.rows if record and request.continues_batch else (),
        )
        yield PreparedBatch(console, request, isolation, cluster, seeds, before, begun)


def _print_isolation(console: Console, isolation: Isolation, cluster: Cluster | None) -> None:
    if cluster:
        console.print(f"{cluster.size} workers, isolation: {isolation.label}", style="dim")
        for line in cluster.left_out:
            console.print(line, style=NOTICE, markup=False)
    if not isolation.trusted:
        console.print(
            f"No isolation: {isolation.reason}. Only visible checks are run, and grades are marked untrusted; grade "
            "only submissions that you trust.",
            style=NOTICE,
            markup=False,
        )


def choose_seeds(
    request: BatchRequest, before: BatchRecord | None, grades: Sequence[Grade], works: Sequence[Work]
) -> Seeds:
    """Return the seeds of a batch.

    Args:
        request: the options of the batch.
        before: the record in the output folder, if any.
        grades: the grades in the output folder; used if an older version wrote no record.
        works: the submissions of the whole class.
    """
    if request.seed is not None:
        return Seeds(request.seed, request.seed_per_student)
    if request.continues_batch and before:
        return replace(before.seeds, per_student=before.seed_per_student or request.seed_per_student)
    if request.continues_batch and (one := _one_seed(grades)) is not None and not request.seed_per_student:
        return Seeds(one)
    if request.shard:  # all machines must compute the same seed
        return Seeds(seed_of_submissions(works), request.seed_per_student)
    return Seeds(
        drawn_seed(), request.seed_per_student, per_submission=request.watch and not request.seed_per_student
    )


def _one_seed(grades: Sequence[Grade]) -> int | None:
    """Return the common seed of all grades; None if their seeds differ."""
    seeds = {grade.seed for grade in grades if grade.seed is not None}
    return seeds.pop() if len(seeds) == 1 else None
