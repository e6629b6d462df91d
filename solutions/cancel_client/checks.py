"""What students can see being checked."""

from __future__ import annotations

from action_msgs.srv import CancelGoal

from autograder.authoring.action_client_checks import require_one_goal
from autograder.authoring.checks import check, program
from autograder.authoring.transcript import Transcript
from autograder.authoring.walking.client import (
    WALK,
    GoalStatus,
    require_feedback_lines,
    require_goal_at,
    require_success,
)
from autograder.authoring.walking.ctrl_c import require_canceled_by_ctrl_c
from autograder.authoring.walking.silence import GIVING_UP, require_no_server, require_silence_noticed

from .judging import (
    require_agreed,
    require_canceled_by_q,
    require_prompt_feedback,
    require_told_refusal,
    require_walk_without_q,
)

GOOD = program(
    "good",
    {
        "arguments": ["1.0", "0.5", "0.3"],
        "distances": [1.12, 0.93, 0.71, 0.5, 0.28, 0.07],
        "final": [0.97, 0.52, 0.31],
    },
)
CANCELED_BY_Q = program("typed", {"lines": ["q"], "ends_after": 1.5})
OVERTAKEN = program("agreed_and_over", {"status": GoalStatus.STATUS_SUCCEEDED, "error_msg": ""})
EARLY = program("typed_early", {"accepted": True})
REFUSING = program("refusing")
INPUT_ENDS = program("end_of_input", {"at_once": False})
NOBODY = program("nobody")
SILENT = program("silent")
INTERRUPTED = program("interrupted", {"ends_after": 1.5})

WITHIN = 15.0  # s for a walk of a few seconds


@check(points=1, on=GOOD, see="06_walk_to_a_pose#follow-task", clauses=[1])
def walks(run: Transcript) -> None:
    """It sends one goal, and says SUCCEEDED with the final pose and status 0"""
    require_success(run, require_goal_at(run, 1.0, 0.5, 0.3), WITHIN)


@check(points=2, on=GOOD, needs=walks, see="05_executors#one-why", clauses=[1, 9])
def prints_feedback_at_once(run: Transcript) -> None:
    """It prints each feedback within 0.5 s, also while nobody types"""
    require_feedback_lines(run, require_one_goal(run, WALK))
    require_prompt_feedback(run)


@check(points=3, on=CANCELED_BY_Q, needs=walks, see="07_cancel_and_preempt#fix-read", clauses=[2, 3])
def q_cancels_the_goal(run: Transcript) -> None:
    """A q and Enter cancel the goal; it waits for its end and ends with status 4"""
    require_canceled_by_q(run, WITHIN)


@check(points=2, on=OVERTAKEN, needs=q_cancels_the_goal, see="07_cancel_and_preempt#late-why", clauses=[3])
def believes_the_end(run: Transcript) -> None:
    """A goal that SUCCEEDED, although the server had agreed to cancel it, ends it with status 0"""
    goal = require_agreed(run, GoalStatus.STATUS_SUCCEEDED)
    require_success(run, goal, WITHIN, canceled=True)


@check(points=2, on=EARLY, needs=q_cancels_the_goal, see="06_walk_to_a_pose#diagram", clauses=[4])
def remembers_an_early_q(run: Transcript) -> None:
    """A q that is typed before the goal is accepted cancels it when it is"""
    require_canceled_by_q(
        run,
        WITHIN,
        help="There is no goal handle yet to cancel with: remember the q, and look for it right after the acceptance.",
    )


@check(points=2, on=REFUSING, needs=q_cancels_the_goal, see="07_cancel_and_preempt#m1-why", clauses=[6])
def reports_a_refusal(run: Transcript) -> None:
    """A refused cancel (code 0, empty goals_canceling) is reported, and the goal goes on to its own end"""
    goal = require_told_refusal(
        run,
        CancelGoal.Response.ERROR_NONE,
        when="because goals_canceling is empty",
        help="Look into the answer of cancel_goal_async(): return_code 0 says only that the request was understood. "
        "The goal is being cancelled if it is in goals_canceling.",
    )
    require_success(run, goal, WITHIN, canceled=True)


@check(points=1, on=INPUT_ENDS, needs=walks, see="07_cancel_and_preempt#button-code", clauses=[5])
def goes_on_at_the_end_of_input(run: Transcript) -> None:
    """The end of the input (Ctrl-D) cancels nothing"""
    require_walk_without_q(run, WITHIN)


@check(points=1, on=NOBODY, see="03_clients_that_survive#fix-why", clauses=[1])
def gives_up_without_a_server(run: Transcript) -> None:
    """Without a server it ends with status 1 after 5 s, and says so on stderr"""
    require_no_server(run, GIVING_UP)


@check(points=1, on=SILENT, needs=walks, see="03_clients_that_survive#fix-why", clauses=[1])
def gives_up_in_silence(run: Transcript) -> None:
    """After 5 s without feedback or result it cancels the goal and ends with status 1"""
    require_silence_noticed(run)


@check(points=1, on=INTERRUPTED, needs=walks, see="06_walk_to_a_pose#field-why", clauses=[1])
def ctrl_c_cancels_the_goal(run: Transcript) -> None:
    """Ctrl-C cancels the goal; it waits for its end and ends with status 4"""
    require_canceled_by_ctrl_c(run, WITHIN)
