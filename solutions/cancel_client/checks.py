"""What students can see being checked."""

from __future__ import annotations

from functools import partial

from autograder.authoring import check_of
from autograder.authoring.walking import every_client
from autograder.authoring.walking.client_obligations import follows
from autograder.authoring.walking.client_scenarios import GOOD, typed, walk, way

from . import model

AGREED_AND_OVER = {"distances": way(60), "ends_after": 3.0, "cancel": {"ends_after": None}}
ARRIVES = {"distances": way(60), "ends_after": 4.0}

CANCELED_BY_Q = walk({**ARRIVES, "cancel": {"ends_after": 1.5}}, *typed("q"))
OVERTAKEN = walk(AGREED_AND_OVER, *typed("q"))
EARLY = walk({**ARRIVES, "after": 2.0, "cancel": {"ends_after": 1.0}}, ["await_goal"], ["type", "q"])
REFUSING = walk({**ARRIVES, "cancel": {"agreed": False, "after": 0.5}}, *typed("q"))
INPUT_ENDS = walk({**ARRIVES, "after": 1.5, "ends_after": 3.0}, *typed(), ["end_input"])

walks = check_of(
    [model.sends_one_goal, follows(1)],
    title="It sends one goal, and says SUCCEEDED with the final pose and status 0",
    on=GOOD,
)

once_it_walks = partial(check_of, needs=walks)
prints_feedback_at_once = once_it_walks(model.prints_each_feedback_in_time, points=2, on=GOOD)

q_cancels_the_goal = once_it_walks(
    follows(2, 3),
    title="A q and Enter cancel the goal; it waits for its end and ends with status 4",
    points=3,
    on=CANCELED_BY_Q,
    see="07_cancel_and_preempt#fix-read",
)

once_q_cancels = partial(check_of, points=2, needs=q_cancels_the_goal)
believes_the_end = once_q_cancels(
    follows(3),
    title="A goal that SUCCEEDED, although the server had agreed to cancel it, ends it with status 0",
    on=OVERTAKEN,
    see="07_cancel_and_preempt#late-why",
)

remembers_an_early_q = once_q_cancels(
    follows(4),
    title="A q that is typed before the goal is accepted cancels it when it is",
    on=EARLY,
    see="06_walk_to_a_pose#diagram",
)

reports_a_refusal = once_q_cancels(
    [follows(6), model.says_what_was_refused],
    title="A refused cancel (code 0, empty goals_canceling) is reported, and the goal goes on to its own end",
    on=REFUSING,
    see="07_cancel_and_preempt#m1-why",
)

goes_on_at_the_end_of_input = once_it_walks(
    follows(5),
    title="The end of the input (Ctrl-D) cancels nothing",
    on=INPUT_ENDS,
    see="07_cancel_and_preempt#button-code",
)

gives_up_without_a_server = every_client.check("gives_up_without_a_server", 1)

gives_up_in_silence = every_client.check("gives_up_in_silence", 1, needs=walks)

ctrl_c_cancels_the_goal = every_client.check("ctrl_c_cancels_the_goal", 1, needs=walks)
