"""A job of a batch: grade one submission, here or on another machine, and return the outcome."""

from __future__ import annotations

import os
import socket
import traceback
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from datetime import datetime, timezone
from typing import TYPE_CHECKING

from autograder.authoring.evidence.transcript import Transcript
from autograder.classroom.batch.grades_without_run import with_reason
from autograder.classroom.batch.version import checks_version
from autograder.classroom.pages.drawings import DrawnRuns, drawing_into
from autograder.engine.exercise import FOLDER_VARIABLE, Exercise, load_exercise
from autograder.engine.grading import GradingOptions, Watcher, grade
from autograder.engine.stop import Stop, Stopped
from autograder.engine.submission import Submission
from autograder.engine.submission_arenas import SubmissionArenas
from autograder.engine.verdict import CheckVerdict, Grade
from autograder.isolation.availability import Isolation, available_isolation
from autograder.recording.kept import Recordings


@dataclass(frozen=True)
class Effort:
    """Time, place and cost of grading one submission.

    Attributes:
        began, ended: UTC, ISO 8601.
        host: the machine's name.
        processor_seconds: of all processes in its arenas; sampled, so the last moments of killed processes are missing.
        arenas: number of arenas opened.
        scenarios: number of scenario runs, including retries.
    """

    began: str
    ended: str
    host: str
    processor_seconds: float = 0.0
    arenas: int = 0
    scenarios: int = 0


def without_arena() -> Effort:
    """Return the effort of a grade that needs no arena, such as an unmarked essay."""
    now = utc_now()
    return Effort(now, now, socket.gethostname())


def utc_now() -> str:
    """Return the present date and time, UTC, ISO 8601."""
    return datetime.now(timezone.utc).isoformat(timespec="seconds")


if TYPE_CHECKING:
    from autograder.recording.recorder import Recorder


@dataclass(frozen=True)
class GradingJob:
    """Everything that a worker needs to grade one submission, including the sources; it can be pickled.

    Attributes:
        student, exercise, sources: the submission.
        seed: draws the inputs of the scenarios.
        trusted: run the hidden checks, too; only an isolated worker may run them.
        version: of the checks and the engine (`checks_version`) that the batch is graded with.
        arenas: number of arenas that run in parallel for this submission.
        course: the folder of exercises, if it is not the clone's own.
        recorded: make recordings of the scenarios.
    """

    student: str
    exercise: str
    sources: Mapping[str, str]
    seed: int
    trusted: bool
    version: str
    arenas: int = 1
    course: str | None = None
    recorded: bool = False

    @property
    def submission(self) -> Submission:
        """The submission, for the engine."""
        return Submission(self.exercise, self.student, self.sources)


@dataclass(frozen=True)
class Outcome:
    """The result of a job.

    Attributes:
        grade: the verdicts.
        drawn: SVG drawings of the runs on which checks failed, by the check's id.
        effort: the time and cost of the grading; None if the worker was lost.
        recordings: MCAP files by name, if the job requests recordings.
        retry_may_succeed: the grader failed, and not because of a wrong set-up.
    """

    grade: Grade
    drawn: DrawnRuns = field(default_factory=dict)
    effort: Effort | None = None
    recordings: Recordings = field(default_factory=dict)
    retry_may_succeed: bool = False


@dataclass(frozen=True)
class BatchWatcher:
    """The callbacks of a batch, which may be called on any thread.

    Attributes:
        on_verdict: called with each verdict as soon as it is known; another machine sends all verdicts of a grade at
            once.
        on_begin, on_end: called with each job of this process when it begins and when it ends.
        on_retry: called with each job that could not be graded and will be retried alone at the end, and its first
            outcome.
    """

    on_verdict: Callable[[CheckVerdict], None] = lambda verdict: None
    on_begin: Callable[[GradingJob], None] = lambda job: None
    on_end: Callable[[GradingJob], None] = lambda job: None
    on_retry: Callable[[GradingJob, Outcome], None] = lambda job, outcome: None


@dataclass(frozen=True)
class SharedState:
    """State that a worker thread shares with the batch; workers in other processes do not have it.

    Attributes:
        isolation: the isolation of this machine.
        stop: ends running gradings when it is set.
        watcher: the callbacks of the batch.
    """

    isolation: Isolation
    stop: Stop
    watcher: BatchWatcher


def carry_out(job: GradingJob, shared: SharedState | None = None) -> Outcome:
    """Grade a submission; an error of the grader gives the grade "not graded", with the error as its reason.

    Raises:
        Stopped: the batch was stopped.
    """
    if shared is None:
        return _graded(job, available_isolation(), Stop(), lambda verdict: None)
    if shared.stop.is_set():
        raise Stopped
    shared.watcher.on_begin(job)
    try:
        return _graded(job, shared.isolation, shared.stop, shared.watcher.on_verdict)
    finally:
        shared.watcher.on_end(job)


def _graded(
    job: GradingJob, isolation: Isolation, stop: Stop, report: Callable[[CheckVerdict], None]
) -> Outcome:
    began, arenas, recorder = utc_now(), None, None
    drawn: dict[str, Sequence[str]] = {}
    draw = drawing_into(drawn)

    def keep_evidence(verdict: CheckVerdict, transcripts: Sequence[Transcript]) -> None:
        draw(verdict, transcripts)
        if recorder:
            recorder.add(verdict, transcripts)

    try:
        if problem := _why_not_here(job, isolation):
            found = Grade(job.exercise, job.student, isolation.label, reason=problem)
        else:
            exercise = load_exercise(job.exercise, hidden=job.trusted)
            recorder = _recorder(exercise) if job.recorded else None
            options = GradingOptions(job.seed, job.arenas, isolation=isolation, recorded=job.recorded)
            watcher = Watcher(on_verdict=report, on_evidence=keep_evidence)
            with SubmissionArenas(exercise.scenario_file, isolation.kind) as arenas:
                found = grade(job.submission, exercise, options, watcher, arenas=arenas, stop=stop)
    except Stopped:
        raise
    except Exception:  # any error here is the grader's fault and must not end the batch
        reason = f"the grader itself failed:\n{traceback.format_exc()}"
        found = Grade(job.exercise, job.student, isolation.label, reason=reason)
    return Outcome(
        with_reason(found),
        drawn,
        _effort(began, arenas),
        recorder.files(found) if recorder else {},
        retry_may_succeed=arenas is not None and found.status == "not graded",
    )


def _effort(began: str, arenas: SubmissionArenas | None) -> Effort:
    here = socket.gethostname()
    if arenas is None:
        return Effort(began, utc_now(), here)
    used = arenas.used
    return Effort(began, utc_now(), here, round(used.processor_seconds, 2), used.arenas, used.scenarios)


def _recorder(exercise: Exercise) -> Recorder:
    # Imported here, because gradings without recordings do not need it.
    from autograder.recording.recorder import Recorder

    return Recorder(exercise, for_students=False)


def _why_not_here(job: GradingJob, isolation: Isolation) -> str:
    """Return the reason why this worker must not grade the job, or ""."""
    here = socket.gethostname()
    if job.trusted and not isolation.trusted:
        return (
            f"the worker on {here} has no isolation ({isolation.reason}), which hidden checks need; take the worker "
            "out of the cluster, or enable namespaces on it, and grade again with --resume"
        )
    if job.course:
        os.environ[FOLDER_VARIABLE] = job.course
    if checks_version(load_exercise(job.exercise, hidden=False).folder) != job.version:
        return (
            f"the worker on {here} has other checks or another engine than the batch; bring its clone to the same "
            "commit, restart the worker, and grade again with --resume"
        )
    return ""
