"""Jobs in the hands of an executor: threads here, or workers elsewhere. Work that gets lost is done again once."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_COMPLETED, CancelledError, Executor, Future, ThreadPoolExecutor, wait
from dataclasses import dataclass

from autograder.batch.job import GradingJob, Outcome
from autograder.batch.special_grades import not_graded


@dataclass(frozen=True)
class Workers:
    """Where jobs are carried out.

    Attributes:
        open: makes an executor, and a new one when that broke.
        at_a_time: how many jobs the executor is given before one of them is done.
        share_memory: they are threads of this process, and see what happens in it.
    """

    open: Callable[[], Executor]
    at_a_time: int
    share_memory: bool = False


def threads(number: int) -> Workers:
    """Return workers in this process."""
    return Workers(lambda: ThreadPoolExecutor(number), number, share_memory=True)


class Crew:
    """Gives jobs to workers and takes the outcomes, each job's once.

    A job whose worker was killed, or whose executor broke, is done again alone when no other is left: one that kills
    its worker takes no other with it twice. If it is lost again, it is "not graded", with the reason.
    """

    def __init__(self, workers: Workers, work: Callable[[GradingJob], Outcome]) -> None:
        self._workers = workers
        self._work = work
        self._executor: Executor | None = None
        self._running: dict[Future[Outcome], GradingJob] = {}
        self._lost: deque[GradingJob] = deque()
        self._alone: GradingJob | None = None

    @property
    def has_room(self) -> bool:
        """Whether it takes another job at once."""
        return len(self._running) < self._workers.at_a_time

    @property
    def is_busy(self) -> bool:
        """Whether there are jobs without an outcome."""
        return bool(self._running or self._lost)

    def give(self, job: GradingJob) -> None:
        """Hand over a job."""
        if self._executor is None:
            self._executor = self._workers.open()
        try:
            future = self._executor.submit(self._work, job)
        except RuntimeError:  # the executor broke meanwhile, and this job had no part in that
            self._close_executor()
            self._executor = self._workers.open()
            future = self._executor.submit(self._work, job)
        self._running[future] = job

    def wait(self, patience: float | None = None) -> Sequence[tuple[GradingJob, Outcome]]:
        """Wait until something happens to a job, or for `patience` s; return those that are done."""
        if not self._running:
            self._alone = self._lost.popleft()
            self._close_executor()  # it may be breaking still, and would take this job with it
            self.give(self._alone)
        done = wait(self._running, timeout=patience, return_when=FIRST_COMPLETED).done
        outcomes = []
        for future in done:
            job = self._running.pop(future)
            try:
                outcomes.append((job, future.result()))
            except (
                Exception,
                CancelledError,
            ) as error:  # the job itself raises nothing, so it is the worker that was lost
                if job is self._alone:
                    outcomes.append((job, _lost_twice(job, error)))
                else:
                    self._lost.append(job)
        return outcomes

    def close(self) -> None:
        """Take back what has not begun; wait for threads of this process, but for no other machine."""
        for future in self._running:
            future.cancel()
        self._close_executor()

    def _close_executor(self) -> None:
        if self._executor:
            self._executor.shutdown(wait=self._workers.share_memory)
            self._executor = None


def _lost_twice(job: GradingJob, error: BaseException) -> Outcome:
    reason = (
        f"the worker was lost twice while it graded this ({type(error).__name__}: {error}); look whether a machine ran "
        "out of memory or was switched off, and grade again with --resume"
    )
    return Outcome(not_graded(job.exercise, job.student, "", reason), "")
