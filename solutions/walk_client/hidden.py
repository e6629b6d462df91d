"""What only the instructor's grading checks."""

from __future__ import annotations

import random

from autograder.authoring.action_client_checks import (
    require_exit,
    require_goal_finished,
    require_one_goal,
)
from autograder.authoring.checks import check, expect, program
from autograder.authoring.missing import unseen
from autograder.authoring.transcript import Transcript
from autograder.authoring.walking.client import (
    ABORTED,
    CANCELED,
    STATUS_HELP,
    WALK,
    GoalStatus,
    require_ending_line,
    require_failure,
    require_feedback_lines,
    require_goal_at,
    require_success,
    require_success_after_early_feedback,
)
from autograder.authoring.walking.ctrl_c import require_end_after_ctrl_c, require_interrupted
from autograder.authoring.walking.silence import (
    require_death_noticed,
    require_no_answer_noticed,
    require_silence_on_the_way_noticed,
)

from .checks import (
    WITHIN,
    ctrl_c_cancels_the_goal,
    gives_up_in_silence,
    gives_up_without_a_server,
    prints_the_feedback,
    says_how_it_succeeded,
    sends_the_goal,
    tells_an_abort,
)


def _any_walk(generator: random.Random, arguments: int = 3) -> dict:
    """A pose with negative numbers, feedback that falls, and an end beside the pose."""
    pose = [-round(generator.uniform(0.3, 2.0), 2), round(generator.uniform(-2.0, -0.3), 2)]
    pose += [round(generator.uniform(-3.0, 3.0), 2)]
    distances = sorted((round(generator.uniform(0.05, 2.5), 2) for _ in range(8)), reverse=True)
    distances[4] = round(distances[3] + generator.uniform(0.1, 0.5), 2)  # a detour
    final = [round(value + generator.uniform(-0.08, 0.08), 2) for value in pose[:2]]
    return {
        "arguments": [str(value) for value in pose[:arguments]],
        "distances": distances,
        "final": [*final, pose[2]],
    }


ANY_WALK = program("good", _any_walk)
WITHOUT_YAW = program("good", lambda generator: _any_walk(generator, arguments=2))
OTHER_NAMESPACE = program("good", _any_walk, namespace="/lab_7/robot")
UNANSWERED = program("unanswered")
SLOW = program("slow_but_lively", {"every": 3.0, "times": 4})
FALLING_SILENT = program("falling_silent")
DYING = program("dying")
EARLY = program("early_feedback", lambda generator: {"distance": round(generator.uniform(3.0, 9.0), 2)})
BY_ANOTHER = program("canceled_by_another")
NO_CODE = program("aborting", {"error_code": 0, "error_msg": ""})
WITH_WORDS = program("succeeding_with_words", {"final": [0.97, 0.52, 0.31]})
FORGETFUL = program("forgetful", {"kept_for": 1.0, "final": [0.97, 0.52, 0.31]})
NEVER_CANCELED = program("interrupted", {"ends_after": None})
ARRIVES = program("interrupted", {"ends_after": None, "arrives_after": 3.0})


@check(
    points=1,
    on=[ANY_WALK, WITHOUT_YAW],
    needs=says_how_it_succeeded,
    see="03_clients_that_survive#fix-frame",
    clauses=[1, 4],
)
def walks_anywhere(with_yaw: Transcript, without_yaw: Transcript) -> None:
    """Negative numbers, and a yaw that is left out, are sent as they are meant"""
    for run in (with_yaw, without_yaw):
        x, y, *yaw = map(float, run.params["arguments"])
        goal = require_goal_at(run, x, y, yaw[0] if yaw else 0.0)
        require_success(run, goal, WITHIN)


@check(
    points=1,
    on=OTHER_NAMESPACE,
    needs=says_how_it_succeeded,
    see="01_robot_and_graph#names-why",
    clauses=[12],
)
def works_in_any_namespace(run: Transcript) -> None:
    """Started in another namespace, it sends the goal to the robot there"""
    require_success(run, require_one_goal(run, WALK), WITHIN)


@check(
    points=1,
    on=UNANSWERED,
    needs=[sends_the_goal, gives_up_without_a_server],
    see="03_clients_that_survive#fix-why",
    clauses=[6, 9],
)
def gives_up_without_an_answer(run: Transcript) -> None:
    """A goal that is never answered ends it with status 1 after 5 s"""
    require_no_answer_noticed(run)


@check(points=2, on=SLOW, needs=gives_up_in_silence, see="03_clients_that_survive#deadline-why", clauses=[8])
def walks_as_long_as_it_takes(run: Transcript) -> None:
    """A walk of 12 s with feedback each 3 s is followed to its end: only silence has a limit"""
    goal = require_one_goal(run, WALK)
    require_success(run, goal, run.params["every"] * run.params["times"] + WITHIN)


@check(
    points=1,
    on=[FALLING_SILENT, DYING],
    needs=walks_as_long_as_it_takes,
    see="03_clients_that_survive#kill-why",
    clauses=[7, 9],
)
def notices_silence_on_the_way(silent: Transcript, dying: Transcript) -> None:
    """A server that falls silent or dies on the way ends it with status 1, 5 s after the last feedback"""
    require_silence_on_the_way_noticed(silent)
    require_death_noticed(dying)


@check(
    points=1,
    on=EARLY,
    needs=[prints_the_feedback, says_how_it_succeeded],
    see="06_walk_to_a_pose#slow-end-why",
    clauses=[12],
)
def survives_early_feedback(run: Transcript) -> None:
    """Feedback that comes before the goal is accepted disturbs nothing"""
    require_success_after_early_feedback(run, WITHIN)


@check(points=1, on=BY_ANOTHER, needs=tells_an_abort, see="07_cancel_and_preempt#cancel-all", clauses=[3, 4])
def tells_a_cancel_by_another(run: Transcript) -> None:
    """A goal that somebody else cancels ends it with status 4, and a line on stdout says CANCELED"""
    goal = require_one_goal(run, WALK)
    require_goal_finished(run, goal, GoalStatus.STATUS_CANCELED)
    exited = require_exit(
        run, WITHIN, CANCELED, because="the goal was CANCELED", stream="stdout", help=STATUS_HELP
    )
    require_ending_line(run, "CANCELED", exited.t)


@check(
    points=2,
    on=[NO_CODE, WITH_WORDS],
    needs=tells_an_abort,
    see="06_walk_to_a_pose#hopeful-why",
    clauses=[3, 9],
)
def believes_the_status(aborted: Transcript, succeeded: Transcript) -> None:
    """The status decides: ABORTED with error_code NONE is 3, SUCCEEDED with an error_msg is 0"""
    goal = require_one_goal(aborted, WALK)
    require_goal_finished(aborted, goal, GoalStatus.STATUS_ABORTED)
    require_failure(aborted, WITHIN, ABORTED, because="the status is ABORTED", help=STATUS_HELP)
    require_success(succeeded, require_one_goal(succeeded, WALK), WITHIN)


@check(points=1, on=FORGETFUL, needs=says_how_it_succeeded, see="06_walk_to_a_pose#late-why", clauses=[12])
def asks_for_the_result_in_time(run: Transcript) -> None:
    """A server that keeps a result for 1 s is asked for it before"""
    goal = require_one_goal(run, WALK)
    finished = require_goal_finished(run, goal, GoalStatus.STATUS_SUCCEEDED)
    asked, forgotten = goal.result_requested, finished.t + run.params["kept_for"]
    expect(
        asked is not None and asked.t < forgotten,
        expected=f"a request for the result before the server forgets it, at {forgotten:.1f} s",
        observed=f"the first at {asked.t:.1f} s" if asked else "none",
        help="Call get_result_async() right after the acceptance; its future is done when the goal ends.",
        at=forgotten,
    )
    require_success(run, goal, WITHIN)


@check(
    points=1,
    on=[NEVER_CANCELED, ARRIVES],
    needs=ctrl_c_cancels_the_goal,
    see="07_cancel_and_preempt#m1-why",
    clauses=[10],
)
def ctrl_c_ends_it_in_any_case(never: Transcript, arrives: Transcript) -> None:
    """After Ctrl-C it ends with status 4, also when the goal SUCCEEDED all the same or has not ended in 5 s"""
    finished = require_goal_finished(arrives, require_one_goal(arrives, WALK), GoalStatus.STATUS_SUCCEEDED)
    if finished.t < require_interrupted(arrives):
        raise unseen(arrives, "the goal ended before Ctrl-C")
    for run in (never, arrives):
        require_end_after_ctrl_c(run, WITHIN)


@check(points=1, on=ANY_WALK, needs=prints_the_feedback, see="06_walk_to_a_pose#slow-end-why", clauses=[2])
def prints_any_feedback(run: Transcript) -> None:
    """Whatever the distances are, they are printed as they came"""
    require_feedback_lines(run, require_one_goal(run, WALK))
