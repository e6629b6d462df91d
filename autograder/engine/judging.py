"""Decides a check's verdict, as a pure function: from its transcripts, or from the verdicts on the checks it needs."""

from __future__ import annotations

import traceback
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from autograder.authoring.checks import Check, Scenario
from autograder.authoring.diagnosis.exit_diagnosis import SANDBOX_FOLDER, is_not_python
from autograder.authoring.diagnosis.readiness import require_ready, require_started
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.failure import CannotBeJudged, Failure, NoOccasion, ReportedBy
from autograder.authoring.lesson import in_words
from autograder.engine.completeness import require_bounded, require_whole
from autograder.engine.verdict import CheckStatus, CheckVerdict

LOG_LINES = 40


def judge(
    check: Check,
    transcripts: Sequence[Transcript],
    *,
    is_last_attempt: bool = False,
    others_failed: bool = False,
) -> CheckVerdict:
    """Judge a check on one transcript of each of its scenarios.

    The verdict is 'passed', 'failed', 'not run' if another check reports the cause, or 'error'. It is an error if the
    arena or the check itself failed, or if the program gave no answer that the check could judge. The last of these is
    a failure if `is_last_attempt`; its advice is to begin with the other checks if `others_failed`.
    """
    log = "\n".join(_log(transcript) for transcript in transcripts)
    try:
        _require_evidence(check, transcripts)
        check.run(transcripts)
    except Failure as failure:
        expected, see = failure.expected, failure.see or check.see
        if any(map(is_not_python, transcripts)):
            expected, see = "a program that Python can read", ""
        return verdict_on(
            check,
            "failed",
            expected=expected,
            observed=_with_steps(failure),
            help=f"{failure.help} Read {in_words(see)}." if see else failure.help,
            lesson=see,
            robot_time=failure.at,
            log=log,
        )
    except ReportedBy as other:
        return _not_run(check, other.title)
    except NoOccasion as requirement:
        if is_last_attempt:
            first = (
                "Fix what the other checks report first"
                if others_failed
                else "Find out what your program did instead, from what it printed"
            )
            return verdict_on(
                check,
                "failed",
                expected=f"an answer from which this can be judged: {requirement}",
                observed=requirement.instead or "none of its answers allows that",
                help=f"{first}: without such an answer this check cannot pass.",
                log=log,
            )
        return verdict_on(check, "error", help=f"Not graded: nothing showed whether {requirement}", log=log)
    except CannotBeJudged as reason:
        return verdict_on(check, "error", help=f"Not graded: {reason}", log=log)
    except Exception:  # a check that raises is the grader's fault, and must cost the student no points
        trace = traceback.format_exc()
        return verdict_on(check, "error", help=f"Not graded: the check itself failed.\n{trace}", log=log)
    return verdict_on(check, "passed", points=check.points, log=log)


def verdict_without_run(check: Check, verdicts: Mapping[str, CheckVerdict]) -> CheckVerdict | None:
    """Return the verdict on a check if one that it needs did not pass; None if it must be judged.

    It is 'error' if a needed check could not be judged, else 'not run'. `verdicts` are by the checks' ids.
    """
    unmet = [verdicts[need.id] for need in check.needs if verdicts[need.id].status != "passed"]
    if not unmet:
        return None
    title = unmet[0].title
    if any(verdict.status == "error" for verdict in unmet):
        return verdict_on(check, "error", help=f"Not graded, because “{title}” was not graded.")
    return _not_run(check, title)


def _not_run(check: Check, needed: str) -> CheckVerdict:
    return verdict_on(check, "not run", help=f"Needs a check that did not pass: “{needed}”.")


def failed_scenarios(check: Check, transcripts: Sequence[Transcript]) -> list[Scenario]:
    """Return the scenarios in which a check did not pass; all its scenarios if it has no obligations."""
    if not check.obligations:
        return list(check.on)
    alone = (
        (replace(check, on=(scenario,)), run) for scenario, run in zip(check.on, transcripts, strict=True)
    )
    return [one.on[0] for one, run in alone if judge(one, [run]).status != "passed"]


def _with_steps(failure: Failure) -> str:
    """Return what was observed and, in a scenario that is a sequence, the steps that led to it."""
    return f"{failure.observed}; steps: {', '.join(failure.steps)}" if failure.steps else failure.observed


def verdict_on(check: Check, status: CheckStatus, *, points: float = 0, **found: Any) -> CheckVerdict:
    """Return the verdict on a check; `found` are further fields of `CheckVerdict`."""
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
    printed = transcript.all(ev.NodeOutput)[-LOG_LINES:]
    lines = [f"{event.t:7.2f} s  {SANDBOX_FOLDER.sub('', event.text)}" for event in printed]
    return "\n".join(lines)
