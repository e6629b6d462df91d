"""What a check raises: a failure, whose `help` is the "next" line of reports, or that there can be no grade."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any


class Failure(Exception):
    """A fault of the submission.

    Args:
        expected: what the check asks for.
        observed: what the submission did instead.
        help: one next step in plain words; reports print it in the line "next".
        at: when it happened, s on the arena's clock.
        see: the lesson it points to, such as "02_services#m9-why"; by default it is the check's.

    `steps` are those of the scenario that led to it, if it is a sequence; they are set by the check.
    """

    steps: Sequence[Sequence[Any]] = ()

    def __init__(
        self, *, expected: str, observed: str, help: str, at: float | None = None, see: str = ""
    ) -> None:
        super().__init__(f"expected {expected}; observed {observed}")
        self.expected = expected
        self.observed = observed
        self.help = help
        self.at = at
        self.see = see


class CannotBeJudged(Exception):
    """The arena did not do what the scenario says, and not because of the submission: there is no grade."""


class NoOccasion(CannotBeJudged):
    """The submission did nothing that lets an obligation be judged; if that stays so, it has not shown it."""


def expect(
    condition: bool, *, expected: str, observed: str, help: str, at: float | None = None, see: str = ""
) -> None:
    """Raise a `Failure` unless the condition holds."""
    if not condition:
        raise Failure(expected=expected, observed=observed, help=help, at=at, see=see)
