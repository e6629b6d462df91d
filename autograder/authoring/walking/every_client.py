"""The checks for every client of `walk_to`; an exercise gives each its clauses and its points."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from autograder.authoring.checks import Check, Scenario
from autograder.authoring.obligation import check_of
from autograder.authoring.walking.client_obligations import follows
from autograder.authoring.walking.client_scenarios import ABORTED, ON_AND_ON, ON_THE_WAY, typed, walk

# id: scenario, title, lesson
CHECKS = {
    "gives_up_without_a_server": (
        walk(None),
        "Without a server it ends with status 1 after 5 s, and says so on stderr",
        "03_clients_that_survive#fix-why",
    ),
    "gives_up_in_silence": (
        walk({"ends_after": None}),
        "After 5 s without feedback or result it cancels the goal and ends with status 1",
        "03_clients_that_survive#fix-why",
    ),
    "tells_an_abort": (
        walk({**ON_THE_WAY, "status": ABORTED, "error_code": 1, "error_msg": "the robot fell at x 0.42 m"}),
        "After an aborted goal it ends with status 3, and prints error_msg on stderr",
        "06_walk_to_a_pose#hopeful-why",
    ),
    "ctrl_c_cancels_the_goal": (
        walk({**ON_AND_ON, "cancel": {"ends_after": 1.5}}, *typed(), ["press_ctrl_c"]),
        "Ctrl-C cancels the goal; it waits for its end and ends with status 4",
        "06_walk_to_a_pose#field-why",
    ),
}


def check(
    id: str,
    *clauses: int,
    points: int = 1,
    needs: Check | Sequence[Check] = (),
    also_on: Sequence[Scenario] = (),
    among: Mapping[str, tuple[Scenario, str, str]] = CHECKS,
) -> Check:
    """Return the check of this name, on its own scenario and the further ones."""
    on, title, see = among[id]
    return check_of(follows(*clauses), title=title, points=points, on=[on, *also_on], needs=needs, see=see)
