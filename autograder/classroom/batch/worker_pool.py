"""Runs jobs on an executor: threads of this process, or workers of a cluster.

Jobs whose worker was lost, and jobs that no arena could grade, are retried once at the end, one at a time.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_COMPLETED, CancelledError, Executor, Future, ThreadPoolExecutor, wait
from dataclasses import dataclass, replace

from autograder.classroom.batch.job import GradingJob, Outcome
from autograder.engine.verdict import Grade


@dataclass(frozen=True)
class Workers:
    """The workers that carry out jobs.

    Attributes:
        open: creates an executor; called again if the executor breaks.
        max_unfinished: number of jobs that may be submitted before one of them is done.
        share_memory: whether the workers are threads of this process.
    """

    open: Callable[[], Executor]
    max_unfinished: int
    share_memory: bool = False


def threads(number: int) -> Workers:
    """Return workers in this process."""
    return Workers(lambda: ThreadPoolExecutor(number), number, share_memory=True)


@dataclass
class WorkerPool:
    """Submits jobs to workers and collects one outcome per job.

    A job is retried after all others if its worker was killed, its executor broke, or its arenas ran and it is "not
    graded". It is retried alone, so that a job that kills its worker cannot disturb others, and so that a busy machine
    has more time for it. The second outcome is final.

    Attributes:
        workers: where the jobs run.
        work: the function that grades a job.
        on_retry: called with each job that will be retried, and its first outcome.
    """

    workers: Workers
    work: Callable[[GradingJob], Outcome]
    on_retry: Callable[[GradingJob, Outcome], None] = lambda job, outcome: None

    def __post_init__(self) -> None:
        self._executor: Executor | None = None
        self._running: dict[Future[Outcome], GradingJob] = {}
        self._to_retry: deque[GradingJob] = deque()
        self._retried: GradingJob | None = None

    @property
    def has_room(self) -> bool:
        """Whether another job can be submitted now."""
        return len(self._running) < self.workers.max_unfinished

    @property
    def is_busy(self) -> bool:
        """Whether there are jobs without an outcome."""
        return bool(self._running or self._to_retry)

    def submit(self, job: GradingJob) -> None:
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

    def wait(self, timeout: float | None = None) -> Sequence[tuple[GradingJob, Outcome]]:
        """Wait until a job is done, for at most `timeout` s; return the jobs that are done, with their outcomes."""
        if not self._running:
            self._retried = replace(self._to_retry.popleft(), arenas=1)
            self._close_executor()  # the old executor may still be breaking and would fail this job, too
            self.submit(self._retried)
        done = wait(self._running, timeout=timeout, return_when=FIRST_COMPLETED).done
        outcomes = []
        for future in done:
            job = self._running.pop(future)
            try:
                outcome = future.result()
            except (
                Exception,
                CancelledError,
            ) as error:  # a job catches its own errors, so the worker was lost
                outcome = _lost(job, error, twice=job is self._retried)
            if job is self._retried or not outcome.retry_may_succeed:
                outcomes.append((job, outcome))
            else:
                self._to_retry.append(job)
                self.on_retry(job, outcome)
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
        f"the worker was lost {'twice ' if twice else ''}while it graded this ({type(error).__name__}: {error}); check "
        "whether a machine ran out of memory or was switched off, and grade again with --resume"
    )
    return Outcome(Grade(job.exercise, job.student, "", reason=reason), retry_may_succeed=True)
