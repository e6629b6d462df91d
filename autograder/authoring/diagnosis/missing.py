"""What a check raises if something it asks about is not in the record: absence of evidence never passes."""

from __future__ import annotations

from autograder.authoring.diagnosis.root_cause import Cause, why_it_went_no_further, why_the_robot_was_held_up
from autograder.authoring.evidence.record import Record
from autograder.authoring.failure import CannotBeJudged, Failure, NoOccasion

_FIRST_OF_ALL = "Find out what your node did just before: the log below shows what it printed, with times."


class Missing(Failure):
    """Something between grader and student's program never happened: 'it was never asked, because …'."""

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
    """Return what to raise if a step of the scenario is missing; `what` is a sentence without its full stop.

    That is a `Failure` where the submission itself is the reason, else `CannotBeJudged`.
    """
    return _exception_for(run, what, why_the_robot_was_held_up(run) or why_it_went_no_further(run))


def not_shown(run: Record, what: str) -> Exception:
    """Return what to raise if nothing shows whether the sentence `what` holds; only the submission decides that."""
    found = unseen(run, f"nothing shows whether {what}")
    return found if isinstance(found, Failure) else NoOccasion(what)


def held_up(run: Record, what: str) -> Exception:
    """Return what to raise if the robot did not do its part; a node that ended does not explain that."""
    return _exception_for(run, what, why_the_robot_was_held_up(run))


def _exception_for(run: Record, what: str, cause: Cause | None) -> Exception:
    if cause is None:
        return CannotBeJudged(f"{run.scenario}: {what}")
    return Failure(
        expected="a node that leaves robot and grader to do their part",
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
