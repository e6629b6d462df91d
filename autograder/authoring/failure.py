"""The exceptions of checks: the submission is at fault, or it cannot be judged."""

from __future__ import annotations

from collections.abc import Sequence


class Failure(Exception):
    """A fault of the submission.

    Args:
        expected: what the check requires.
        observed: what the submission did instead.
        help: one next step in plain words; reports print it after "next".
        at: when it happened, s on the arena's clock.
        see: the lesson to read, such as "02_services#m9-why"; by default that of the check.

    If the scenario is a sequence, the check sets `steps` to the steps that led to the failure, in words.
    """

    steps: Sequence[str] = ()

    def __init__(
        self, *, expected: str, observed: str, help: str, at: float | None = None, see: str = ""
    ) -> None:
        super().__init__(f"expected {expected}; observed {observed}")
        self.expected = expected
        self.observed = observed
        self.help = help
        self.at = at
        self.see = see


class ReportedBy(Exception):
    """Another check reports why this one cannot be judged, so that it is reported as not run.

    Args:
        title: of that check.
    """

    def __init__(self, title: str) -> None:
        super().__init__(title)
        self.title = title


class CannotBeJudged(Exception):
    """The arena did not carry out the scenario, and the submission is not the cause: there is no grade."""


class NoOccasion(CannotBeJudged):
    """The run had no occasion to judge an obligation. If the retries have none either, the check fails.

    Args:
        what: the sentence that could not be judged.
        instead: what the run shows instead, '' if nothing is known.
    """

    def __init__(self, what: str, instead: str = "") -> None:
        super().__init__(what)
        self.instead = instead


def expect(
    condition: bool, *, expected: str, observed: str, help: str, at: float | None = None, see: str = ""
) -> None:
    """Raise a `Failure` unless the condition holds."""
    if not condition:
        raise Failure(expected=expected, observed=observed, help=help, at=at, see=see)
