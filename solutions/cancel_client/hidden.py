"""What only the instructor's grading checks."""

from __future__ import annotations

import random

from action_msgs.srv import CancelGoal

from autograder.authoring import events as ev
from autograder.authoring.action_client_checks import require_one_goal, require_single_cancel
from autograder.authoring.checks import check, program
from autograder.authoring.missing import unseen
from autograder.authoring.transcript import Transcript
from autograder.authoring.walking.client import (
    WALK,
    GoalStatus,
    require_abort,
    require_goal_at,
    require_rejection,
    require_success,
    require_success_after_early_feedback,
    require_usage,
)
from autograder.authoring.walking.silence import (
    require_death_noticed,
    require_no_answer_noticed,
    require_silence_on_the_way_noticed,
)

from .checks import (
    WITHIN,
    believes_the_end,
    gives_up_in_silence,
    gives_up_without_a_server,
    goes_on_at_the_end_of_input,
    prints_feedback_at_once,
    q_cancels_the_goal,
    remembers_an_early_q,
    reports_a_refusal,
    walks,
)
from .judging import (
    require_agreed,
    require_canceled_by_q,
    require_told_refusal,
    require_typed,
    require_walk_without_q,
)


def _any_walk(generator: random.Random) -> dict:
    """A pose with negative numbers, feedback that falls, and an end beside the pose."""
    pose = [-round(generator.uniform(0.3, 2.0), 2), round(generator.uniform(-2.0, -0.3), 2)]
    pose += [round(generator.uniform(-3.0, 3.0), 2)]
    distances = sorted((round(generator.uniform(0.05, 2.5), 2) for _ in range(8)), reverse=True)
    distances[4] = round(distances[3] + generator.uniform(0.1, 0.5), 2)  # a detour
    final = [round(value + generator.uniform(-0.08, 0.08), 2) for value in pose[:2]]
    return {"arguments": [str(value) for value in pose], "distances": distances, "final": [*final, pose[2]]}


ANY_WALK = program("good", _any_walk, namespace="/lab_7/robot")
TOO_FEW = program("without_node", {"arguments": ["1.0"]})
ABORTING = program("aborting", {"error_code": 1, "error_msg": "the robot fell at x 0.42 m"})
REJECTED_EARLY = program("typed_early", {"accepted": False})
ABORTED_ANYWAY = program(
    "agreed_and_over", {"status": GoalStatus.STATUS_ABORTED, "error_msg": "it fell while it stopped"}
)
TOO_LATE = program("too_late")
DEAF = program("deaf_to_cancels")
TWICE = program("typed", {"lines": ["q", "q", "q"], "ends_after": 2.5})
OTHER_LINES = program("typed", {"lines": ["", "w", "stop"], "ends_after": 1.0})
NO_INPUT = program("end_of_input", {"at_once": True})
UNANSWERED = program("unanswered")
FALLING_SILENT = program("falling_silent")
DYING = program("dying")
EARLY = program("early_feedback", lambda generator: {"distance": round(generator.uniform(3.0, 9.0), 2)})


@check(points=1, on=ANY_WALK, needs=walks, see="01_robot_and_graph#names-why", clauses=[1])
def walks_anywhere(run: Transcript) -> None:
    """Another namespace, another pose with negative numbers"""
    require_success(run, require_goal_at(run, *map(float, run.params["arguments"])), WITHIN)


@check(points=1, on=TOO_FEW, needs=walks, see="03_clients_that_survive#fix-frame", clauses=[1])
def refuses_wrong_arguments(run: Transcript) -> None:
    """Wrong arguments end it with status 2 and the usage, before a node is started"""
    require_usage(run, WITHIN)


@check(points=1, on=ABORTING, needs=walks, see="06_walk_to_a_pose#hopeful-why", clauses=[1])
def tells_an_abort(run: Transcript) -> None:
    """An aborted goal ends it with status 3, and error_msg stands on stderr"""
    require_abort(run, WITHIN)


@check(
    points=1,
    on=REJECTED_EARLY,
    needs=remembers_an_early_q,
    see="06_walk_to_a_pose#reject-task",
    clauses=[1, 4],
)
def a_rejected_goal_needs_no_cancel(run: Transcript) -> None:
    """A goal that is rejected after a q ends it with status 2"""
    require_typed(run)
    require_rejection(run, WITHIN)


@check(
    points=1,
    on=ABORTED_ANYWAY,
    needs=[believes_the_end, tells_an_abort],
    see="07_cancel_and_preempt#late-why",
    clauses=[3],
)
def tells_an_abort_after_q(run: Transcript) -> None:
    """A goal that is ABORTED after the server had agreed to cancel it ends it with status 3"""
    require_agreed(run, GoalStatus.STATUS_ABORTED)
    require_abort(run, WITHIN)


@check(points=2, on=TOO_LATE, needs=reports_a_refusal, see="07_cancel_and_preempt#late-why", clauses=[3, 7])
def reports_a_late_cancel(run: Transcript) -> None:
    """A cancel that comes when the goal has ended (code 3) is reported, and the goal's end decides"""
    goal = require_told_refusal(
        run,
        CancelGoal.Response.ERROR_GOAL_TERMINATED,
        when="because the return_code was ERROR_GOAL_TERMINATED",
        help="Every answer without your goal in goals_canceling is a refusal, whatever its return_code.",
    )
    require_success(run, goal, WITHIN, canceled=True)


@check(points=2, on=DEAF, needs=q_cancels_the_goal, see="03_clients_that_survive#kill-why", clauses=[8])
def does_not_wait_for_the_answer(run: Transcript) -> None:
    """A cancel that gets no answer holds up nothing: the goal is followed to its end"""
    goal = require_one_goal(run, WALK)
    require_typed(run)
    cancel = require_single_cancel(run, goal, because="you typed q", help="Call cancel_goal_async() at a q.")
    if cancel.reply is not None:
        raise unseen(run, "the cancel was answered")
    require_success(run, goal, WITHIN, canceled=True)


@check(points=1, on=TWICE, needs=q_cancels_the_goal, see="07_cancel_and_preempt#late-why", clauses=[2])
def cancels_once(run: Transcript) -> None:
    """However often q is typed, the goal is cancelled once"""
    if len(run.all(ev.NodeTyped)) < 2:
        raise unseen(run, "q was typed only once")
    require_canceled_by_q(run, WITHIN)


@check(
    points=1, on=OTHER_LINES, needs=q_cancels_the_goal, see="07_cancel_and_preempt#button-code", clauses=[5]
)
def other_lines_cancel_nothing(run: Transcript) -> None:
    """Only q cancels: an empty line or another word does not"""
    require_walk_without_q(run, WITHIN)


@check(
    points=1,
    on=NO_INPUT,
    needs=goes_on_at_the_end_of_input,
    see="07_cancel_and_preempt#button-code",
    clauses=[5],
)
def walks_without_an_input(run: Transcript) -> None:
    """Started where there is no input, it walks all the same"""
    require_walk_without_q(run, WITHIN)


@check(
    points=1,
    on=UNANSWERED,
    needs=[walks, gives_up_without_a_server],
    see="03_clients_that_survive#fix-why",
    clauses=[1],
)
def gives_up_without_an_answer(run: Transcript) -> None:
    """A goal that is never answered ends it with status 1 after 5 s"""
    require_no_answer_noticed(run)


@check(
    points=1,
    on=[FALLING_SILENT, DYING],
    needs=gives_up_in_silence,
    see="03_clients_that_survive#kill-why",
    clauses=[1],
)
def notices_silence_on_the_way(silent: Transcript, dying: Transcript) -> None:
    """A server that falls silent or dies on the way ends it with status 1, 5 s after the last feedback"""
    require_silence_on_the_way_noticed(silent)
    require_death_noticed(dying)


@check(
    points=1,
    on=EARLY,
    needs=[walks, prints_feedback_at_once],
    see="06_walk_to_a_pose#slow-end-why",
    clauses=[1],
)
def survives_early_feedback(run: Transcript) -> None:
    """Feedback that comes before the goal is accepted disturbs nothing"""
    require_success_after_early_feedback(run, WITHIN)
