"""Judges a check on the transcripts it asks for: a pure function."""

from __future__ import annotations

import traceback
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from autograder.authoring import lesson
from autograder.authoring.checks import Check, Scenario
from autograder.authoring.diagnosis.readiness import require_ready, require_started
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.failure import CannotBeJudged, Failure, NoOccasion
from autograder.authoring.sequence import in_words
from autograder.engine.bounds import require_bounded
from autograder.engine.completeness import require_whole
from autograder.engine.verdict import CheckStatus, CheckVerdict

LOG_LINES = 40


def judge(check: Check, transcripts: Sequence[Transcript], *, finally_: bool = False) -> CheckVerdict:
    """Judge a check on one transcript of each of its scenarios.

    The verdict is 'passed', 'failed' or 'error'. 'error': the arena or the check itself failed, or the program gave
    no answer that the check could judge; in the last attempt (`finally_`) the latter is 'failed'.
    """
    log = "\n".join(_log(transcript) for transcript in transcripts)
    try:
        _require_evidence(check, transcripts)
        check.run(transcripts)
    except Failure as failure:
        return verdict_on(
            check,
            "failed",
            expected=failure.expected,
            observed=_with_steps(failure),
            help=_with_lesson(failure.help, failure.see or check.see),
            robot_time=failure.at,
            log=log,
        )
    except NoOccasion as nothing:
        if finally_:
            return verdict_on(
                check,
                "failed",
                expected=f"an answer that shows this: {nothing}",
                observed="none, in any of its answers",
                help=_with_lesson(
                    "Fix what the other checks report first: without such an answer this cannot be judged.",
                    check.see,
                ),
                log=log,
            )
        return verdict_on(check, "error", help=f"Not graded: nothing showed whether {nothing}", log=log)
    except CannotBeJudged as trouble:
        return verdict_on(check, "error", help=f"Not graded: {trouble}", log=log)
    except Exception:  # a check that breaks is our fault and must cost the student nothing
        trace = traceback.format_exc()
        return verdict_on(check, "error", help=f"Not graded: the check itself failed.\n{trace}", log=log)
    return verdict_on(check, "passed", points=check.points, log=log)


def at_fault(check: Check, transcripts: Sequence[Transcript]) -> list[Scenario]:
    """Return the scenarios in which a check does not pass; all its scenarios if it has no obligations."""
    if not check.obligations:
        return list(check.on)
    alone = (
        (replace(check, on=(scenario,)), run) for scenario, run in zip(check.on, transcripts, strict=True)
    )
    return [one.on[0] for one, run in alone if judge(one, [run]).status != "passed"]


def _with_steps(failure: Failure) -> str:
    """Return what was observed and, in a scenario that is a sequence, the steps that led to it."""
    return f"{failure.observed}; steps: {in_words(failure.steps)}" if failure.steps else failure.observed


def _with_lesson(help: str, see: str) -> str:
    return f"{help} Read {lesson.in_words(see)}." if see else help


def verdict_on(check: Check, status: CheckStatus, *, points: float = 0, **found: Any) -> CheckVerdict:
    """Return the record of what a check found: `found` are the other fields of a `CheckVerdict`."""
    of_the_check: dict[str, Any] = {
        "max_points": check.points,
        "hidden": check.hidden,
        "promise": check.promise,
    }
    return CheckVerdict(check.id, check.title, status, points, **of_the_check, **found)


def _require_evidence(check: Check, transcripts: Sequence[Transcript]) -> None:
    """Require that each run began with the student's program and that its record is complete."""
    for scenario, transcript in zip(check.on, transcripts, strict=True):
        if scenario.student == "node":
            require_ready(transcript)
        else:
            require_started(transcript)
        require_bounded(transcript, scenario)
        require_whole(transcript, scenario)


def _log(transcript: Transcript) -> str:
    """Return the last lines that the student's process printed, with their times."""
    lines = [f"{event.t:7.2f} s  {event.text}" for event in transcript.all(ev.NodeOutput)][-LOG_LINES:]
    return "\n".join(lines)
