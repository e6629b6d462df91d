"""The checks that students can see and run themselves."""

from __future__ import annotations

from functools import partial

from autograder.authoring import check_of
from autograder.authoring.walking import every_client
from autograder.authoring.walking.client_obligations import follows
from autograder.authoring.walking.client_scenarios import GOOD, typed, walk, way

from . import model

IGNORES_ACCEPTED_CANCEL = {"distances": way(60), "ends_after": 3.0, "cancel": {"ends_after": None}}
ARRIVES = {"distances": way(60), "ends_after": 4.0}

CANCELED_BY_Q = walk({**ARRIVES, "cancel": {"ends_after": 1.5}}, *typed("q"))
OVERTAKEN = walk(IGNORES_ACCEPTED_CANCEL, *typed("q"))
EARLY = walk({**ARRIVES, "after": 2.0, "cancel": {"ends_after": 1.0}}, ["await_goal"], ["type", "q"])
REFUSING = walk({**ARRIVES, "cancel": {"agreed": False, "after": 0.5}}, *typed("q"))
INPUT_ENDS = walk({**ARRIVES, "after": 1.5, "ends_after": 3.0}, *typed(), ["end_input"])

walks = check_of(
    [model.sends_one_goal, follows(1)],
    title="It sends one goal, prints SUCCEEDED with the final pose, and exits with status 0",
    on=GOOD,
)

once_it_walks = partial(check_of, needs=walks)
prints_feedback_at_once = once_it_walks(model.prints_each_feedback_in_time, points=2, on=GOOD)

q_cancels_the_goal = once_it_walks(
    follows(2, 3),
    title="After q and Enter it cancels the goal, waits for its result, and exits with status 4",
    points=3,
    on=CANCELED_BY_Q,
    see="07_cancel_and_preempt#fix-read",
)

once_q_cancels = partial(check_of, points=2, needs=q_cancels_the_goal)
believes_the_end = once_q_cancels(
    follows(3),
    title="If the goal SUCCEEDED although the server had accepted the cancel, it exits with status 0",
    on=OVERTAKEN,
    see="07_cancel_and_preempt#late-why",
)

remembers_an_early_q = once_q_cancels(
    follows(4),
    title="If q is typed before the goal is accepted, it cancels the goal right after its acceptance",
    on=EARLY,
    see="06_walk_to_a_pose#diagram",
)

reports_a_refusal = once_q_cancels(
    [follows(6), model.says_what_was_refused],
    title="If the cancel is rejected (code 0, empty goals_canceling), it says so and waits for the goal's result",
    on=REFUSING,
    see="07_cancel_and_preempt#m1-why",
)

goes_on_at_the_end_of_input = once_it_walks(
    follows(5),
    title="At the end of the input (Ctrl-D) it does not cancel the goal",
    on=INPUT_ENDS,
    see="07_cancel_and_preempt#button-code",
)

gives_up_without_a_server = every_client.check("gives_up_without_a_server", 1)

gives_up_in_silence = every_client.check("gives_up_in_silence", 1, needs=walks)

ctrl_c_cancels_the_goal = every_client.check("ctrl_c_cancels_the_goal", 1, needs=walks)
