"""Judges what a node refuses: sets, and values from the start."""

from __future__ import annotations

from autograder.authoring import events as ev
from autograder.authoring.client_checks import require_failure
from autograder.authoring.failure import Failure, expect
from autograder.authoring.readiness import require_alive, require_within_limits
from autograder.authoring.transcript import Transcript

from .sets import call_named, changes

GIVING_UP = 12.0  # s for a program to refuse what it is started with


def require_refused(run: Transcript, name: str, because: str, help: str) -> None:
    """Require that every set of a request was refused, with a reason."""
    require_alive(run, "Refuse by returning SetParametersResult(successful=False, reason=…); raise nothing.")
    for change in changes(call_named(run, name)):
        at = change.call.answered.t
        expect(
            not change.accepted,
            expected=f"{change.words} is refused: {because}",
            observed="accepted",
            help=help,
            at=at,
        )
        expect(
            bool(change.reason.strip()),
            expected=f"a reason why {change.words} is refused",
            observed="an empty reason",
            help='Give SetParametersResult a reason, too: "kp_pitch is 40.0; it has to be above 51.0".',
            at=at,
        )


def require_bad_start_refused(run: Transcript) -> None:
    """Require that the program ended with status 1 and a line on stderr, not with a traceback."""
    require_within_limits(run)
    started = f"{run.params['name']}:={run.params['value']}"
    if run.first(ev.NodeExited) is None:
        raise Failure(
            expected=f"a program that ends with status 1 when it is started with {started}",
            observed=f"it still runs; the last line on stderr: {run.last_words}"
            if run.last_words
            else "it still runs",
            help="It knows of the bad value and goes on. Return 1 from main() instead, for nobody may notice that "
            "other gains are in use than those that were asked for."
            if run.params["name"] in run.output("stderr")
            else "Declaring sets the values from the start: refuse it in the on-set callback, and register that before "
            "you declare.",
            at=run.end,
        )
    require_failure(run, GIVING_UP, (1,), f"it was started with {started}")
