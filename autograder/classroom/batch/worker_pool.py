"""Runs jobs on an executor: threads of this process, or workers of a cluster.

Jobs whose worker was lost, and jobs that no arena could grade, are repeated once at the end, one at a time.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_COMPLETED, CancelledError, Executor, Future, ThreadPoolExecutor, wait
from dataclasses import dataclass, replace

from autograder.classroom.batch.grades_without_run import not_graded
from autograder.classroom.batch.job import GradingJob, Outcome

RetryLater = Callable[[GradingJob, Outcome], None]


@dataclass(frozen=True)
class Workers:
    """Where jobs are carried out.

    Attributes:
        open: creates an executor; called again if that breaks.
        at_a_time: number of jobs to submit before one of them is done.
        share_memory: whether the workers are threads of this process.
    """

    open: Callable[[], Executor]
    at_a_time: int
    share_memory: bool = False


def threads(number: int) -> Workers:
    """Return workers in this process."""
    return Workers(lambda: ThreadPoolExecutor(number), number, share_memory=True)


@dataclass
class WorkerPool:
    """Submits jobs to workers and collects one outcome per job.

    A job is repeated alone, after all others, if its worker was killed, its executor broke, or arenas ran for it and it
    is "not graded": alone, a job that kills its worker harms no other, and a busy machine has more time for it. The
    second outcome is final.

    Attributes:
        workers: where the jobs run.
        work: the function that grades a job.
        retry_later: gets each job that will be repeated, with its first outcome.
    """

    workers: Workers
    work: Callable[[GradingJob], Outcome]
    retry_later: RetryLater = lambda job, outcome: None

    def __post_init__(self) -> None:
        self._executor: Executor | None = None
        self._running: dict[Future[Outcome], GradingJob] = {}
        self._once_more: deque[GradingJob] = deque()
        self._alone: GradingJob | None = None

    @property
    def has_room(self) -> bool:
        """Whether another job can be submitted now."""
        return len(self._running) < self.workers.at_a_time

    @property
    def is_busy(self) -> bool:
        """Whether there are jobs without an outcome."""
        return bool(self._running or self._once_more)

    def give(self, job: GradingJob) -> None:
        """Submit a job."""
        if self._executor is None:
            self._executor = self.workers.open()
        try:
            future = self._executor.submit(self.work, job)
        except RuntimeError:  # the executor broke before this job
            self._close_executor()
            self._executor = self.workers.open()
            future = self._executor.submit(self.work, job)
        self._running[future] = job

    def wait(self, patience: float | None = None) -> Sequence[tuple[GradingJob, Outcome]]:
        """Wait until something happens to a job, or for `patience` s; return those that are done."""
        if not self._running:
            self._alone = replace(self._once_more.popleft(), arenas=1)
            self._close_executor()  # the old executor may still be breaking and would fail this job, too
            self.give(self._alone)
        done = wait(self._running, timeout=patience, return_when=FIRST_COMPLETED).done
        outcomes = []
        for future in done:
            job = self._running.pop(future)
            try:
                outcome = future.result()
            except (Exception, CancelledError) as error:  # the job itself raises nothing: the worker was lost
                outcome = _lost(job, error, twice=job is self._alone)
            if job is self._alone or not outcome.may_end_otherwise:
                outcomes.append((job, outcome))
            else:
                self._once_more.append(job)
                self.retry_later(job, outcome)
        return outcomes

    def close(self) -> None:
        """Cancel jobs that have not begun; wait for threads of this process, but not for other machines."""
        for future in self._running:
            future.cancel()
        self._close_executor()

    def _close_executor(self) -> None:
        if self._executor:
            self._executor.shutdown(wait=self.workers.share_memory)
            self._executor = None


def _lost(job: GradingJob, error: BaseException, *, twice: bool) -> Outcome:
    reason = (
        f"the worker was lost {'twice ' if twice else ''}while it graded this ({type(error).__name__}: {error}); look "
        "whether a machine ran out of memory or was switched off, and grade again with --resume"
    )
    return Outcome(not_graded(job.exercise, job.student, "", reason), "", may_end_otherwise=True)
