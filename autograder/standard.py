"""Checks that every server owes, whatever it serves: one line each in an exercise's checks.

server_appears = standard.server_appears("get_battery_status", points=1, on=INTERRUPT)
ends_cleanly = standard.ends_cleanly(points=1, on=INTERRUPT, needs=server_appears)
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from autograder.checks import Check, Scenario, check, expect
from autograder.common_checks import require_calls, require_clean_exit
from autograder.readiness import require_ready
from autograder.transcript import Transcript

Needs = Check | Sequence[Check]


def server_appears(what: str, *, points: int, on: Scenario, see: str = "") -> Check:
    """The node offers `what`, in words; `on` is best the shortest scenario, as this verdict is waited for."""
    return _check("server_appears", f"The node offers {what}", require_ready, points=points, on=on, see=see)


def ends_cleanly(*, points: int, on: Scenario, needs: Needs, see: str = "") -> Check:
    """Ctrl-C ends the node with exit status 0; the scenario presses it."""
    title = "Ctrl-C ends the node with exit status 0"
    return _check("ends_cleanly", title, require_clean_exit, points=points, on=on, needs=needs, see=see)


def answers_every_request(
    title: str, *, requests: int, within: float, help: str, points: int, on: Scenario, needs: Needs
) -> Check:
    """All `requests` of the scenario are answered, each `within` so many s."""

    def judge(run: Transcript) -> None:
        latencies = [call.latency for call in require_calls(run, requests)]
        expect(
            max(latencies) <= within,
            expected=f"every answer within {within:g} s",
            observed=f"the slowest of {len(latencies)} took {max(latencies):.1f} s",
            help=help,
        )

    return _check("answers_every_request", title, judge, points=points, on=on, needs=needs)


def works_in_any_namespace(
    does: str, require: Callable[[Transcript], Any], *, points: int, on: Scenario, needs: Needs
) -> Check:
    """Started in another namespace it does the same, which `require` asks of the run, and `does` says in words."""
    title = f"Started in another namespace, it {does} there"
    return _check("works_in_any_namespace", title, require, points=points, on=on, needs=needs)


def _check(
    id: str,
    title: str,
    require: Callable[[Transcript], Any],
    *,
    points: int,
    on: Scenario,
    needs: Needs = (),
    see: str = "",
) -> Check:
    def judge(run: Transcript) -> None:
        require(run)

    judge.__name__, judge.__doc__ = id, title
    return check(points=points, on=on, needs=needs, see=see)(judge)
