"""One unit of a batch's work: a submission to grade, which can be sent to another machine, and what comes back."""

from __future__ import annotations

import os
import socket
import traceback
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from autograder.authoring.evidence.transcript import Transcript
from autograder.classroom.batch.effort import Effort, utc_now
from autograder.classroom.batch.grades_without_run import not_graded, with_reason
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

if TYPE_CHECKING:
    from autograder.recording.recorder import Recorder


@dataclass(frozen=True)
class GradingJob:
    """Everything that a worker needs to grade one submission, including the sources; it can be pickled.

    Attributes:
        student, exercise, sources: the submission.
        seed: draws the inputs of its scenarios.
        trusted: make the hidden checks too, which only an isolated worker may do.
        version: of the checks and the engine (`checks_version`) that the batch is graded with.
        arenas: how many of this submission run at a time.
        course: the folder of exercises, if it is not the clone's own.
        recorded: make recordings of its scenarios.
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
        """The submission as the engine takes it."""
        return Submission(self.exercise, self.student, self.sources)


@dataclass(frozen=True)
class Outcome:
    """The result of a job.

    Attributes:
        grade: the verdicts.
        isolation: the label of what the worker had; "" if no worker answered.
        drawn: SVG of the runs that failed checks were judged on, by the check's id.
        effort: what it took; None if no worker answered.
        recordings: MCAP files by name, if they were asked for.
        may_end_otherwise: the grader failed in a way that a retry may avoid (not a fault of its set-up).
    """

    grade: Grade
    isolation: str
    drawn: DrawnRuns = field(default_factory=dict)
    effort: Effort | None = None
    recordings: Recordings = field(default_factory=dict)
    may_end_otherwise: bool = False


@dataclass(frozen=True)
class Live:
    """State that a worker thread shares with the batch; workers in other processes run without it.

    Attributes:
        isolation: of this machine.
        stop: ends what runs.
        report: gets each verdict.
        begins, ends: get each job.
    """

    isolation: Isolation
    stop: Stop
    report: Callable[[CheckVerdict], None]
    begins: Callable[[GradingJob], None]
    ends: Callable[[GradingJob], None]


def carry_out(job: GradingJob, live: Live | None = None) -> Outcome:
    """Grade a submission; whatever goes wrong is the reason of a grade "not graded".

    Raises:
        Stopped: the batch was stopped.
    """
    if live is None:
        return _graded(job, available_isolation(), Stop(), lambda verdict: None)
    if live.stop.is_set():
        raise Stopped
    live.begins(job)
    try:
        return _graded(job, live.isolation, live.stop, live.report)
    finally:
        live.ends(job)


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
            found = not_graded(job.exercise, job.student, isolation.label, problem)
        else:
            exercise = load_exercise(job.exercise, hidden=job.trusted)
            arenas = SubmissionArenas(exercise.scenario_file, isolation.kind)
            recorder = _recorder(exercise) if job.recorded else None
            options = GradingOptions(job.seed, job.arenas, isolation=isolation, recorded=job.recorded)
            watcher = Watcher(on_verdict=report, on_evidence=keep_evidence)
            found = grade(job.submission, exercise, options, watcher, arenas=arenas, stop=stop)
    except Stopped:
        raise
    except Exception:  # whatever goes wrong here is the grader's fault and may not end the batch
        reason = f"the grader itself failed:\n{traceback.format_exc()}"
        found = not_graded(job.exercise, job.student, isolation.label, reason)
    return Outcome(
        with_reason(found),
        isolation.label,
        drawn,
        _effort(began, arenas),
        recorder.files(found) if recorder else {},
        may_end_otherwise=arenas is not None and found.status == "not graded",
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
            f"the worker on {here} has no isolation ({isolation.reason}), and hidden checks need it; take it out of "
            "the cluster, or let it have namespaces, and grade again with --resume"
        )
    if job.course:
        os.environ[FOLDER_VARIABLE] = job.course
    if checks_version(load_exercise(job.exercise, hidden=False).folder) != job.version:
        return (
            f"the worker on {here} has other checks or another engine than the batch; bring its clone to the same "
            "commit, start it again, and grade again with --resume"
        )
    return ""
