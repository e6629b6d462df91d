"""The hidden checks, which only the instructor's grading runs."""

from __future__ import annotations

from autograder.authoring import check_of, program
from autograder.authoring.walking import client_scenarios as scene
from autograder.authoring.walking import every_client
from autograder.authoring.walking.client_obligations import follows
from autograder.classroom.hidden_checks import every_client_hidden

from . import checks, model
from .checks import ARRIVES, IGNORES_ACCEPTED_CANCEL

ANY_WALK = program("in_order", scene.any_walk, namespace="/lab_7/robot")
ANY_COURSE = program("in_order", lambda random: scene.any_course(random, types=True))
WRONG = program(
    "in_order",
    lambda random: {"arguments": random.choice(scene.WRONG_ARGUMENTS), "server": {}, "steps": []},
)
REJECTED_EARLY = scene.walk({"accepted": False, "after": 2.0}, ["await_goal"], ["type", "q"])
ABORTED_ANYWAY = scene.walk(
    {**IGNORES_ACCEPTED_CANCEL, "status": scene.ABORTED, "error_msg": "it fell while it stopped"},
    *scene.typed("q"),
)
TOO_LATE = scene.walk(
    {"distances": scene.way(3), "ends_after": 1.0, "result_after": 2.5}, *scene.typed("q", after=1.3)
)
NO_CANCEL_RESPONSE = scene.walk(
    {"distances": scene.way(60), "ends_after": 8.0, "cancel": {"agreed": None}}, *scene.typed("q")
)
CTRL_C_AFTER_Q = program(
    "in_order", lambda random: scene.ctrl_c(random, {"ends_after": 4.2, "cancel": {"agreed": False}}, "q")
)
OFTEN = scene.walk(
    {**ARRIVES, "after": 3.2, "ends_after": 6.0, "cancel": {"agreed": False}},
    *(["type", "w\nq"], ["wait", 3.0], ["offer"]),  # two pasted lines; the server and its response come late
    *scene.typed("q", "q", after=3.0),
)
NEVER_CANCELED = scene.walk(
    {**scene.ON_AND_ON, "cancel": {"ends_after": None}}, *scene.typed("q"), ["press_ctrl_c"]
)
OTHER_LINES = scene.walk(scene.ON_AND_ON, *scene.typed("", "quit", "stop", "q"))
NO_INPUT = scene.walk({**ARRIVES, "after": 1.5, "ends_after": 3.0}, ["end_input"])
SILENT_ON_THE_WAY = program("in_order", lambda random: scene.silence_on_the_way(random, types=True))

walks_anywhere = check_of(
    [model.sends_one_goal, follows(1)],
    title="It works in another namespace, and with negative numbers",
    on=ANY_WALK,
    needs=checks.walks,
    see="01_robot_and_graph#names-why",
)

refuses_wrong_arguments = check_of(model.refuses_what_is_no_pose, on=WRONG, needs=checks.walks)

tells_an_abort = every_client.check("tells_an_abort", 1, needs=checks.walks)

a_rejected_goal_needs_no_cancel = check_of(
    follows(1, 4),
    title="If the goal is rejected after a q, it exits with status 2",
    on=REJECTED_EARLY,
    needs=checks.remembers_an_early_q,
    see="06_walk_to_a_pose#reject-task",
)

tells_an_abort_after_q = check_of(
    follows(3),
    title="If the goal is ABORTED after the server had accepted the cancel, it exits with status 3",
    on=ABORTED_ANYWAY,
    needs=[checks.believes_the_end, tells_an_abort],
    see="07_cancel_and_preempt#late-why",
)

reports_a_late_cancel = check_of(
    [follows(3, 7), model.says_what_was_refused],
    title="If the cancel comes after the goal's end (code 3), it says so, and the result decides the exit status",
    points=2,
    on=TOO_LATE,
    needs=checks.reports_a_refusal,
    see="07_cancel_and_preempt#late-why",
)

does_not_wait_for_the_answer = check_of(
    follows(3, 8),
    title="It does not wait for the response to a cancel; after a q, Ctrl-C still ends it with status 4",
    points=2,
    on=[NO_CANCEL_RESPONSE, CTRL_C_AFTER_Q, NEVER_CANCELED],
    needs=[checks.q_cancels_the_goal, checks.ctrl_c_cancels_the_goal],
    see="03_clients_that_survive#kill-why",
)

cancels_once = check_of(
    follows(2),
    title="It cancels the goal only once, however early and often q is typed, and whatever the response",
    on=OFTEN,
    needs=checks.remembers_an_early_q,
    see="07_cancel_and_preempt#late-why",
)

other_lines_cancel_nothing = check_of(
    follows(5),
    title="It cancels only after q, not after an empty line or another word such as quit",
    on=OTHER_LINES,
    needs=checks.q_cancels_the_goal,
    see="07_cancel_and_preempt#button-code",
)

walks_without_an_input = check_of(
    follows(5),
    title="It works without any input, too",
    on=NO_INPUT,
    needs=checks.goes_on_at_the_end_of_input,
    see="07_cancel_and_preempt#button-code",
)

gives_up_without_an_answer = every_client_hidden.check(
    "gives_up_without_an_answer", 1, needs=[checks.walks, checks.gives_up_without_a_server]
)

notices_silence_on_the_way = check_of(
    model.holds_whatever_happens,
    title="If feedback stops or the server dies on the way, it exits with status 1, also after a q; every clause holds "
    "in any situation",
    on=[SILENT_ON_THE_WAY, ANY_COURSE],
    needs=[checks.gives_up_in_silence, checks.ctrl_c_cancels_the_goal],
    see="03_clients_that_survive#kill-why",
)

survives_early_feedback = every_client_hidden.check(
    "survives_early_feedback", 1, needs=[checks.walks, checks.prints_feedback_at_once]
)
