"""The exceptions for evidence that is missing in a record: absence of evidence never passes."""

from __future__ import annotations

from autograder.authoring.diagnosis.root_cause import Cause, why_it_went_no_further, why_the_robot_was_held_up
from autograder.authoring.evidence.record import Record
from autograder.authoring.failure import CannotBeJudged, Failure, NoOccasion

_FIRST_OF_ALL = "Find out what your node did just before: the log below shows what it printed, with times."


class Missing(Failure):
    """A request, a goal or a step of the scenario never happened, because of the submission."""

    def __init__(self, run: Record, *, expected: str, never: str) -> None:
        cause = why_it_went_no_further(run) or why_the_robot_was_held_up(run)
        why = cause.words if cause else f"the scenario went no further than {run.end:.1f} s"
        super().__init__(
            expected=expected,
            observed=f"{never}, because {why}",
            help=cause.help if cause else _FIRST_OF_ALL,
            at=cause.at if cause else run.end,
            see=cause.see if cause else "",
        )


def unseen(run: Record, what: str) -> Exception:
    """Return the exception for missing evidence: a `Failure` if the submission is the cause, else `CannotBeJudged`.

    `what` says what is missing, in a sentence without its full stop.
    """
    return _exception_for(run, what, why_the_robot_was_held_up(run) or why_it_went_no_further(run))


def not_shown(run: Record, what: str) -> Exception:
    """Return the exception if a run does not show whether the sentence `what` holds: a `Failure` or `NoOccasion`."""
    found = unseen(run, f"nothing shows whether {what}")
    return found if isinstance(found, Failure) else NoOccasion(what)


def held_up(run: Record, what: str) -> Exception:
    """Return the exception if the robot did not do its part: a `Failure` if the submission overloaded it.

    That the node has ended does not count as the cause.
    """
    return _exception_for(run, what, why_the_robot_was_held_up(run))


def _exception_for(run: Record, what: str, cause: Cause | None) -> Exception:
    if cause is None:
        return CannotBeJudged(f"{run.scenario}: {what}")
    return Failure(
        expected="a node that does not keep robot and grader from their work",
        observed=f"{what}, because {cause.words}",
        help=cause.help,
        at=cause.at,
        see=cause.see,
    )


def ordinal(number: int) -> str:
    """Return 'first', 'second', …; beyond tenth 'number 11'."""
    words = (
        *("first", "second", "third", "fourth", "fifth"),
        *("sixth", "seventh", "eighth", "ninth", "tenth"),
    )
    return words[number - 1] if number <= len(words) else f"number {number}"
