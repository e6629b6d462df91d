"""Checks that fit every server: one line each in an exercise's checks.

server_appears = standard.server_appears("get_battery_status", points=1, on=INTERRUPT)
ends_cleanly = standard.ends_cleanly(points=1, on=INTERRUPT, needs=server_appears)
"""

from __future__ import annotations

from collections.abc import Sequence

from autograder.authoring.checks import Check, Scenario, check_by
from autograder.authoring.diagnosis.readiness import require_ready
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.obligation import check_of, obligation, whole_run
from autograder.authoring.requirements.server_checks import require_clean_exit

Needs = Check | Sequence[Check]


def server_appears(
    what: str,
    *,
    points: int = 1,
    on: Scenario,
    see: str = "02_services#first-file",
    clauses: Sequence[int] = (),
) -> Check:
    """Make the check that the node offers `what`; choose the shortest scenario, as this verdict comes first."""
    title = f"The node offers {what}"
    return check_by(require_ready, title, points=points, on=on, see=see, clauses=clauses)


def ends_cleanly(
    *,
    points: int = 1,
    on: Scenario | Sequence[Scenario],
    needs: Needs,
    see: str = "02_services#conventions",
    clauses: Sequence[int] = (),
) -> Check:
    """Make the check that Ctrl-C, which each scenario presses, ends the node with exit status 0."""

    def exits_with_status_0(run: Transcript) -> str:
        """Ctrl-C ends the node with exit status 0."""
        require_clean_exit(run)
        return "Ctrl-C"

    exits = obligation(*clauses, of=whole_run)(exits_with_status_0)
    return check_of(exits, points=points, on=on, needs=needs, see=see, to_its_end=False)
