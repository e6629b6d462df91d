"""Checks that fit every server and that students do not see: one line each in an exercise's hidden checks.

The students' copy of the engine is without this module.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

from autograder.authoring.checks import Check, Scenario, expect, named_check
from autograder.authoring.obligation import Obligation, check_of
from autograder.authoring.server_checks import require_calls
from autograder.authoring.standard import Needs
from autograder.authoring.transcript import Transcript

_FROM_MEMORY = "Answer from memory: the callback must not sleep or wait for the next message."


def answers_every_request(
    requests: int,
    *,
    points: int,
    on: Scenario,
    needs: Needs,
    within: float = 2.0,
    help: str = _FROM_MEMORY,
    see: str = "02_services#m4-why",
    clauses: Sequence[int] = (),
) -> Check:
    """Make the check that all `requests` of the scenario, many at once, are answered within so many s."""

    def judge(run: Transcript) -> None:
        latencies = [call.latency for call in require_calls(run, requests)]
        expect(
            max(latencies) <= within,
            expected=f"every answer within {within:g} s",
            observed=f"the slowest of {len(latencies)} took {max(latencies):.1f} s",
            help=help,
        )

    title = f"{requests} requests, many at once, are all answered, each within {within:g} s"
    return named_check(
        "answers_every_request", title, judge, points=points, on=on, needs=needs, see=see, clauses=clauses
    )


def works_in_any_namespace(
    does: str,
    require: Callable[[Transcript], Any] | Obligation,
    *,
    points: int,
    on: Scenario,
    needs: Needs,
    see: str = "01_robot_and_graph#names-why",
    clauses: Sequence[int] = (),
) -> Check:
    """Make the check that the node does the same in another namespace: `require` tests it, `does` names it.

    Where `require` is an obligation, `clauses` take the place of its own: here it holds that names are relative.
    """
    id, title = "works_in_any_namespace", f"Started in another namespace, it {does} there"
    if isinstance(require, Obligation):
        there = replace(require, sentence=title, clauses=tuple(clauses)) if clauses else require
        return check_of(id, there, title=title, points=points, on=on, needs=needs, see=see)
    return named_check(id, title, require, points=points, on=on, needs=needs, see=see, clauses=clauses)
