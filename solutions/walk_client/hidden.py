"""The hidden checks, which only the instructor's grading runs."""

from __future__ import annotations

from random import Random

from autograder.authoring import check_of, program
from autograder.authoring.walking import client_scenarios as scene
from autograder.authoring.walking.client_obligations import follows
from autograder.classroom.hidden_checks import every_client_hidden

from . import checks, model


def _arrives(random: Random) -> scene.Script:
    """Draw a scenario with Ctrl-C and a server that rejects the cancel, so that the goal ends by itself."""
    status = random.choice([scene.SUCCEEDED, scene.ABORTED])
    return scene.ctrl_c(random, {"ends_after": 4.2, "status": status, "cancel": {"agreed": False}})


WITHOUT_YAW = program("in_order", lambda random: scene.any_walk(random, arguments=2))
ANY_COURSE = program("in_order", scene.any_course)
OTHER_NAMESPACE = program("in_order", scene.any_walk, namespace="/lab_7/robot")
SLOW = program("in_order", scene.slow_walk)
SILENT_ON_THE_WAY = program("in_order", scene.silence_on_the_way)
BY_ANOTHER = scene.walk({**scene.ON_THE_WAY, "status": scene.CANCELED})
NO_CODE = scene.walk({"ends_after": 1.0, "status": scene.ABORTED})
PREEMPTED = scene.walk(
    {"ends_after": 1.0, "status": scene.ABORTED, "error_code": 2, "error_msg": "a later goal took the robot"}
)
WITH_WORDS = scene.walk({**scene.ON_THE_WAY, "error_msg": "the floor is slippery"})
KEEPS_RESULT_1_S = scene.walk({**scene.ON_THE_WAY, "kept_for": 1.0})
ARRIVES = program("in_order", _arrives)

walks_anywhere = check_of(
    model.holds_whatever_happens,
    title="It sends the right pose for negative numbers and without a yaw; every clause holds with any server",
    on=[WITHOUT_YAW, ANY_COURSE],
    needs=[checks.says_how_it_succeeded, checks.ctrl_c_cancels_the_goal],
    see="03_clients_that_survive#fix-frame",
)

works_in_any_namespace = check_of(
    [model.sends_one_goal, follows(12)],
    title="Started in another namespace, it sends the goal to the robot there",
    on=OTHER_NAMESPACE,
    needs=checks.says_how_it_succeeded,
    see="01_robot_and_graph#names-why",
)

gives_up_without_an_answer = every_client_hidden.check(
    "gives_up_without_an_answer", 6, 9, needs=[checks.sends_the_goal, checks.gives_up_without_a_server]
)

walks_as_long_as_it_takes = check_of(
    [model.sends_one_goal, follows(8)],
    title="It waits for a late server, a late response, and a walk of a minute with feedback at most 4.5 s apart",
    points=2,
    on=SLOW,
    needs=checks.gives_up_in_silence,
    see="03_clients_that_survive#deadline-why",
)

notices_silence_on_the_way = check_of(
    follows(7, 9),
    title="If feedback stops or the server dies on the way, it exits with status 1, 5 s after the last feedback",
    on=SILENT_ON_THE_WAY,
    needs=walks_as_long_as_it_takes,
    see="03_clients_that_survive#kill-why",
)

survives_early_feedback = every_client_hidden.check(
    "survives_early_feedback", 12, needs=[checks.prints_the_feedback, checks.says_how_it_succeeded]
)

tells_a_cancel_by_another = check_of(
    follows(3, 4),
    title="If another client cancels the goal, it exits with status 4, and a line on stdout says CANCELED",
    on=BY_ANOTHER,
    needs=checks.tells_an_abort,
    see="07_cancel_and_preempt#cancel-all",
)

believes_the_status = check_of(
    follows(3, 9),
    title="Only the goal's status decides: after ABORTED it exits with 3 at any error_code, after SUCCEEDED with 0",
    points=2,
    on=[NO_CODE, PREEMPTED, WITH_WORDS],
    needs=checks.tells_an_abort,
    see="06_walk_to_a_pose#hopeful-why",
)

asks_for_the_result_in_time = check_of(
    [model.asks_for_its_result, follows(12)],
    title="It requests the result in time from a server that keeps it for only 1 s",
    on=KEEPS_RESULT_1_S,
    needs=checks.says_how_it_succeeded,
)

ctrl_c_ends_it_in_any_case = check_of(
    follows(10),
    title="After Ctrl-C it waits for the goal's end and exits with status 4, also if the server rejects the cancel",
    on=ARRIVES,
    needs=checks.ctrl_c_cancels_the_goal,
    see="07_cancel_and_preempt#m1-why",
)

prints_any_feedback = check_of(
    model.prints_each_feedback,
    title="It prints all distances unchanged",
    on=WITHOUT_YAW,
    needs=checks.prints_the_feedback,
    see="06_walk_to_a_pose#slow-end-why",
)
