"""Jobs in the hands of an executor: threads here, or workers elsewhere.

Work that gets lost, and what no arena could grade, is done once more at the end, alone.
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


class WorkerPool:
    """Gives jobs to workers and takes the outcomes, each job's once.

    A job whose worker was killed, or whose executor broke, is done again alone when no other is left: one that kills
    its worker takes no other with it twice. So is one that arenas ran for and that is "not graded": the machine was
    too busy, and alone it has more of it. What comes of the second time counts.

    Args:
        workers: carry out the jobs.
        work: what they do with each.
        retry_later: gets each job that is to be done again, and what came of it the first time.
    """

    def __init__(
        self,
        workers: Workers,
        work: Callable[[GradingJob], Outcome],
        retry_later: RetryLater = lambda job, outcome: None,
    ) -> None:
        self._workers = workers
        self._work = work
        self._retry_later = retry_later
        self._executor: Executor | None = None
        self._running: dict[Future[Outcome], GradingJob] = {}
        self._once_more: deque[GradingJob] = deque()
        self._alone: GradingJob | None = None

    @property
    def has_room(self) -> bool:
        """Whether it takes another job at once."""
        return len(self._running) < self._workers.at_a_time

    @property
    def is_busy(self) -> bool:
        """Whether there are jobs without an outcome."""
        return bool(self._running or self._once_more)

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
            self._alone = replace(self._once_more.popleft(), arenas=1)
            self._close_executor()  # it may be breaking still, and would take this job with it
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
                self._retry_later(job, outcome)
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


def _lost(job: GradingJob, error: BaseException, *, twice: bool) -> Outcome:
    reason = (
        f"the worker was lost {'twice ' if twice else ''}while it graded this ({type(error).__name__}: {error}); look "
        "whether a machine ran out of memory or was switched off, and grade again with --resume"
    )
    return Outcome(not_graded(job.exercise, job.student, "", reason), "", may_end_otherwise=True)
