"""Hidden checks for any server; an exercise adds one to its hidden checks with one line.

The students' copy of the course does not have this module.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

from autograder.authoring import Check, Obligation, Scenario, Transcript, check_of
from autograder.authoring.checks import check_by
from autograder.authoring.requirements.standard import Needs


def works_in_any_namespace(
    does: str,
    require: Callable[[Transcript], Any] | Obligation,
    *,
    points: int = 1,
    on: Scenario,
    needs: Needs,
    see: str = "01_robot_and_graph#names-why",
    clauses: Sequence[int] = (),
) -> Check:
    """Return the check that the node works in another namespace: `require` tests what `does` describes.

    If `clauses` are given, they replace the clauses of an obligation in `require`, because this check tests that names
    are relative.
    """
    title = f"Started in another namespace, it {does} there"
    if isinstance(require, Obligation):
        there = replace(require, sentence=title, clauses=tuple(clauses)) if clauses else require
        return check_of(there, title=title, points=points, on=on, needs=needs, see=see)
    return check_by(require, title, points=points, on=on, needs=needs, see=see, clauses=clauses)
