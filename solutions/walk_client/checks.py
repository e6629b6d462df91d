"""What students can see being checked."""

from __future__ import annotations

from autograder.authoring.action_client_checks import require_one_goal
from autograder.authoring.checks import check, program
from autograder.authoring.transcript import Transcript
from autograder.authoring.walking.client import (
    WALK,
    require_abort,
    require_feedback_lines,
    require_goal_at,
    require_rejection,
    require_success,
    require_usage,
)
from autograder.authoring.walking.ctrl_c import require_canceled_by_ctrl_c
from autograder.authoring.walking.silence import GIVING_UP, require_no_server, require_silence_noticed

GOOD = program(
    "good",
    {
        "arguments": ["1.0", "0.5", "0.3"],
        "distances": [1.12, 0.93, 0.71, 0.5, 0.28, 0.07],
        "final": [0.97, 0.52, 0.31],
    },
)
TOO_FEW = program("without_node", {"arguments": ["1.0"]})
NO_NUMBER = program("without_node", {"arguments": ["one", "0.5"]})
NOBODY = program("nobody")
REJECTING = program("rejecting")
ABORTING = program("aborting", {"error_code": 1, "error_msg": "the robot fell at x 0.42 m"})
SILENT = program("silent")
INTERRUPTED = program("interrupted", {"ends_after": 1.5})

WITHIN = 10.0  # s for a walk of a second or two


@check(points=2, on=GOOD, see="06_walk_to_a_pose#client-intro", clauses=[1])
def sends_the_goal(run: Transcript) -> None:
    """It sends one goal, at x, y and yaw in frame odom"""
    require_goal_at(run, 1.0, 0.5, 0.3)


@check(points=2, on=GOOD, needs=sends_the_goal, see="06_walk_to_a_pose#field-why", clauses=[2])
def prints_the_feedback(run: Transcript) -> None:
    """It prints a line for each feedback, with distance_remaining"""
    require_feedback_lines(run, require_one_goal(run, WALK))


@check(points=2, on=GOOD, needs=sends_the_goal, see="06_walk_to_a_pose#follow-task", clauses=[3, 4])
def says_how_it_succeeded(run: Transcript) -> None:
    """When the goal SUCCEEDED it prints so with the final pose, and ends with status 0"""
    require_success(run, require_one_goal(run, WALK), WITHIN)


@check(
    points=1,
    on=[TOO_FEW, NO_NUMBER],
    needs=says_how_it_succeeded,
    see="03_clients_that_survive#fix-frame",
    clauses=[11],
)
def refuses_wrong_arguments(too_few: Transcript, no_number: Transcript) -> None:
    """Wrong arguments end it with status 2 and the usage, before a node is started"""
    for run in (too_few, no_number):
        require_usage(run, WITHIN)


@check(points=1, on=NOBODY, see="03_clients_that_survive#fix-why", clauses=[6, 9])
def gives_up_without_a_server(run: Transcript) -> None:
    """Without a server it ends with status 1 after 5 s, and says so on stderr"""
    require_no_server(run, GIVING_UP)


@check(
    points=1, on=REJECTING, needs=says_how_it_succeeded, see="06_walk_to_a_pose#client-intro", clauses=[5, 9]
)
def tells_a_rejection(run: Transcript) -> None:
    """A rejected goal ends it with status 2"""
    require_rejection(run, WITHIN)


@check(
    points=2, on=ABORTING, needs=says_how_it_succeeded, see="06_walk_to_a_pose#hopeful-why", clauses=[3, 9]
)
def tells_an_abort(run: Transcript) -> None:
    """An aborted goal ends it with status 3, and error_msg stands on stderr"""
    require_abort(run, WITHIN)


@check(
    points=2, on=SILENT, needs=says_how_it_succeeded, see="03_clients_that_survive#fix-why", clauses=[7, 9]
)
def gives_up_in_silence(run: Transcript) -> None:
    """After 5 s without feedback or result it cancels the goal and ends with status 1"""
    require_silence_noticed(run)


@check(points=2, on=INTERRUPTED, needs=says_how_it_succeeded, see="06_walk_to_a_pose#field-why", clauses=[10])
def ctrl_c_cancels_the_goal(run: Transcript) -> None:
    """Ctrl-C cancels the goal; it waits for its end and ends with status 4"""
    require_canceled_by_ctrl_c(run, WITHIN)
