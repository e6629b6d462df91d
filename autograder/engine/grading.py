"""Grades one submission: runs the scenarios that its checks need, judges the transcripts, gives each check a verdict.

A failed check is retried in a second arena and costs points only if it fails again: middleware and machines fail now
and then, but a fault of the submission shows every time. A program that Python cannot compile is not retried. A check
without the evidence that it needs is retried on slower clocks, before it counts as not graded.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from contextlib import nullcontext
from dataclasses import dataclass, replace

from autograder.authoring.checks import Check, Scenario
from autograder.authoring.diagnosis.exit_diagnosis import is_not_python, ran_to_its_end
from autograder.authoring.diagnosis.root_cause import why_the_robot_was_held_up
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.sequence import STEPS, steps_until
from autograder.engine.arena_run import ArenaRun, NotGraded, run_in_arena
from autograder.engine.clock_scale import ClockScale
from autograder.engine.exercise import Exercise, exercises_folder
from autograder.engine.judging import failed_scenarios, judge, verdict_on, verdict_without_run
from autograder.engine.path_exposure import require_hidden
from autograder.engine.simulation_lag import MAX_LAG, RETRY_LAG, lateness
from autograder.engine.stop import Stop, Stopped
from autograder.engine.submission import Submission
from autograder.engine.submission_arenas import SubmissionArenas
from autograder.engine.verdict import CheckStatus, CheckVerdict, Grade
from autograder.isolation.availability import Isolation, available_isolation
from ros_runtime.course_error import CommandFailed

Runs = dict[Scenario, Future[Transcript]]

LONGEST_TRIED = 3  # last steps of a drawn sequence that are rerun alone, to find the shortest failing part
VISIBLE_SEED = 0  # of the visible checks' scenarios: the same inputs in a self-check and in every batch
MOST_ATTEMPTS: dict[CheckStatus, int] = {"passed": 1, "failed": 2, "not run": 2, "error": 4}


@dataclass(frozen=True)
class GradingOptions:
    """How a submission is graded.

    Attributes:
        seed: draws the inputs of the scenarios that only hidden checks judge.
        jobs: how many arenas run at a time.
        scale: of every arena's clock; None: what the machine can bear.
        isolation: of the arenas; None: the best this machine has.
        recorded: have the transcripts hold whole postures of the robot, for recordings; no check sees them.
        first_alone: run no other scenario beside the first one, so that the first verdict comes soon.
        checks_without_retry: ids of checks that are not retried after a failure; for audits, which award no points.
        shortens: after a failure in a drawn sequence, find the shortest part of the sequence that still fails.
    """

    seed: int = 0
    jobs: int = 2
    scale: float | None = None
    isolation: Isolation | None = None
    recorded: bool = False
    first_alone: bool = False
    checks_without_retry: Collection[str] = ()
    shortens: bool = True


@dataclass(frozen=True)
class Watcher:
    """Functions that are called while a submission is graded, on any thread.

    Attributes:
        on_verdict: receives each verdict as soon as it is known.
        on_retry: receives each check that did not pass and is retried.
        on_evidence: receives each verdict from transcripts, with these transcripts.
        on_running: receives the running scenarios whenever they change.
    """

    on_verdict: Callable[[CheckVerdict], None] = lambda verdict: None
    on_retry: Callable[[Check], None] = lambda check: None
    on_evidence: Callable[[CheckVerdict, Sequence[Transcript]], None] = lambda verdict, transcripts: None
    on_running: Callable[[Sequence[Scenario]], None] = lambda scenarios: None


def grade(
    submission: Submission,
    exercise: Exercise,
    options: GradingOptions = GradingOptions(),
    watcher: Watcher = Watcher(),
    *,
    arenas: SubmissionArenas | None = None,
    stop: Stop | None = None,
) -> Grade:
    """Grade a submission with the checks of the exercise, visible and hidden.

    `arenas` are the caller's, which stay open; None: new ones. When `stop` is set, running arenas are ended at once.

    Raises:
        Stopped: `stop` was set before the last verdict.
    """
    isolation = options.isolation or available_isolation()
    if any(check.hidden for check in exercise.checks):
        if not isolation.trusted:
            raise CommandFailed(f"hidden checks need isolated arenas: {isolation.reason}")
        require_hidden([exercise.folder, exercises_folder()])
    options = replace(options, isolation=isolation)
    with nullcontext(arenas) if arenas else SubmissionArenas(exercise.scenario_file, isolation.kind) as ours:
        return _Session(submission, exercise, options, watcher, ours, stop).run()


class _Session:
    """The state of one grading: transcripts by attempt and scenario, and verdicts by check."""

    def __init__(
        self,
        submission: Submission,
        exercise: Exercise,
        options: GradingOptions,
        watcher: Watcher,
        arenas: SubmissionArenas,
        stop: Stop | None,
    ) -> None:
        assert options.isolation, "grade() sets it"
        self._submission = submission
        self._exercise = exercise
        self._options = options
        self._isolation = options.isolation
        self._scale = ClockScale(options.scale)
        self._watcher = watcher
        self._arenas = arenas
        self._visible = {scenario for check in exercise.checks if not check.hidden for scenario in check.on}
        self._stop = Stop(stop)
        self._verdicts: dict[str, CheckVerdict] = {}
        self._runs: list[Runs] = [{} for _ in range(max(MOST_ATTEMPTS.values()))]  # by attempt
        # number of runs of a scenario that left a check without a final verdict, by check id and scenario
        self._attempts: Counter[tuple[str, Scenario]] = Counter()

    def run(self) -> Grade:
        jobs, first_alone = self._options.jobs, self._options.first_alone
        with ThreadPoolExecutor(jobs) as pool:
            try:
                while len(self._verdicts) < len(self._exercise.checks):
                    if self._stop.is_set():
                        raise Stopped
                    self._judge_ready_checks()
                    alone = first_alone and not any(run.done() for run in self._runs[0].values())
                    running = self._start(pool, 1 if alone else jobs)
                    if running:
                        wait(running, return_when=FIRST_COMPLETED)
            finally:
                self._stop.set()
        verdicts = [self._verdicts[check.id] for check in self._exercise.checks]
        return Grade(
            self._exercise.name,
            self._submission.student,
            self._isolation.label,
            verdicts,
            seed=self._options.seed,
            program=self._submission.fingerprint,
        )

    def _judge_ready_checks(self) -> None:
        """Give a verdict on every check whose runs have ended, and on every check that needs no run."""
        for check in self._exercise.checks:
            if check.id in self._verdicts or not all(need.id in self._verdicts for need in check.needs):
                continue
            if verdict := verdict_without_run(check, self._verdicts):
                self._conclude(verdict)
                continue
            while check.id not in self._verdicts and all(run and run.done() for run in self._runs_of(check)):
                self._judge(check)

    def _start(self, pool: ThreadPoolExecutor, jobs: int) -> list[Future[Transcript]]:
        """Keep `jobs` arenas busy, first with what is certainly needed, and return the runs."""
        running = {run: scenario for runs in self._runs for scenario, run in runs.items() if not run.done()}
        for scenario, attempt in self._wanted():
            if len(running) >= jobs:
                break
            if scenario in self._runs[attempt]:  # several checks want it
                continue
            run = (
                pool.submit(self._run_again, scenario, attempt)
                if attempt
                else pool.submit(self._run_first, scenario)
            )
            self._runs[attempt][scenario] = run
            running[run] = scenario
        self._watcher.on_running(list(running.values()))
        return list(running)

    def _wanted(self) -> list[tuple[Scenario, int]]:
        """Return the scenarios to run with their attempt numbers, first those of checks whose needs have verdicts."""
        certain: list[tuple[Scenario, int]] = []
        possible: list[tuple[Scenario, int]] = []
        for check in self._exercise.checks:
            if check.id in self._verdicts:
                continue
            met = all(need.id in self._verdicts for need in check.needs)
            attempts = ((scenario, self._attempts[check.id, scenario]) for scenario in check.on)
            wanted = certain if met else possible
            wanted += [
                (scenario, attempt) for scenario, attempt in attempts if scenario not in self._runs[attempt]
            ]
        return certain + possible

    def _run_first(self, scenario: Scenario) -> Transcript:
        """Run a scenario for the first time."""
        return self._run(scenario, self._scale.first_scale(scenario), MAX_LAG)

    def _run_again(self, scenario: Scenario, attempt: int) -> Transcript:
        """Run a scenario again, at a scale that the machine keeps up with, because this run can cost points.

        A third or later attempt means that needed evidence was missing, so each uses a slower clock than the last.
        """
        before = self._runs[attempt - 1][scenario].result()
        too_fast = attempt > 1 or lateness(before) > RETRY_LAG
        return self._run(scenario, self._scale.retry_scale(before.scale, too_fast), RETRY_LAG)

    def _run(self, scenario: Scenario, scale: float, tolerated: float) -> Transcript:
        """Run a scenario; repeat it at a lower scale if it was more than `tolerated` s late, or if its arena failed.

        At scale 1, MAX_LAG is tolerated.
        """
        problem: NotGraded | None = None
        for attempt_scale in self._scale.attempts(scale):
            run = ArenaRun(
                self._exercise,
                self._submission.files,
                scenario,
                VISIBLE_SEED if scenario in self._visible else self._options.seed,
                attempt_scale,
                self._isolation.kind,
                recorded=self._options.recorded,
            )
            try:
                transcript = run_in_arena(run, self._stop, self._arenas)
            except NotGraded as error:
                problem = error
                if self._stop.is_set():
                    break
                continue
            allowed = tolerated if attempt_scale > 1 else MAX_LAG
            if not scenario.timed or lateness(transcript) <= allowed or why_the_robot_was_held_up(transcript):
                return transcript
            self._scale.was_late()
            problem = NotGraded(
                f"the machine was too busy: at scale {attempt_scale:g} the arena fell {lateness(transcript):.1f} s "
                "behind its clock; grade again with fewer jobs, or when the machine has less other work"
            )
        raise problem or NotGraded("no attempt was made")

    def _runs_of(self, check: Check) -> list[Future[Transcript] | None]:
        """Return the current run of each of a check's scenarios; None for one that has not started."""
        return [self._runs[self._attempts[check.id, scenario]].get(scenario) for scenario in check.on]

    def _judge(self, check: Check) -> None:
        """Judge a check on its latest runs; a pass is final, anything else is retried up to MOST_ATTEMPTS."""
        try:
            transcripts = [run.result() for run in self._runs_of(check) if run]
        except NotGraded as error:
            if self._stop.is_set():
                raise Stopped from None
            self._conclude(verdict_on(check, "error", help=f"Not graded: {error}"))
            return
        attempt = max(self._attempts[check.id, scenario] for scenario in check.on)
        verdict = judge(
            check,
            transcripts,
            is_last_attempt=attempt + 1 >= MOST_ATTEMPTS["error"],
            others_failed=any(other.status == "failed" for other in self._verdicts.values()),
        )
        is_fixed = any(map(is_not_python, transcripts)) or (
            all(map(ran_to_its_end, transcripts)) and not any(scenario.timed for scenario in check.on)
        )  # another run cannot differ
        no_retry = verdict.status in ("failed", "not run") and (
            check.id in self._options.checks_without_retry or is_fixed
        )
        if verdict.status != "passed" and not no_retry:
            again = failed_scenarios(check, transcripts)
            for scenario in again:
                self._attempts[check.id, scenario] += 1
            if all(self._attempts[check.id, each] < MOST_ATTEMPTS[verdict.status] for each in again):
                self._watcher.on_retry(check)
                return
            if verdict.status == "failed" and (shorter := self._shorter_failure(check, again, transcripts)):
                verdict, transcripts = shorter
        self._watcher.on_evidence(verdict, transcripts)
        self._conclude(verdict)

    def _shorter_failure(
        self, check: Check, failed: Sequence[Scenario], transcripts: Sequence[Transcript]
    ) -> tuple[CheckVerdict, list[Transcript]] | None:
        """Rerun the last one, two and three steps of a failed drawn sequence; return the shortest failure, or None.

        The points are lost already; a short sequence makes the verdict easier to read.
        """
        runs = list(transcripts)
        index = next((check.on.index(scenario) for scenario in failed if scenario.is_drawn), None)
        if (
            not self._options.shortens
            or not check.obligations
            or index is None
            or not check.on[index].is_light
        ):
            return None
        drawn, run = check.on[index], runs[index]
        steps = steps_until(run, judge(replace(check, on=(drawn,)), [run]).robot_time)
        for length in range(1, min(LONGEST_TRIED, len(steps) - 1) + 1):
            alone = replace(drawn, inputs={**run.params, STEPS: steps[-length:]})
            try:
                runs[index] = self._run_first(alone)
            except NotGraded:
                continue  # for example, because the steps need earlier ones
            verdict = judge(check, runs)
            if verdict.status == "failed":
                return verdict, runs
        return None

    def _conclude(self, verdict: CheckVerdict) -> None:
        self._verdicts[verdict.id] = verdict
        self._watcher.on_verdict(verdict)
