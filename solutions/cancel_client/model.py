"""What must hold for every run of the cancel client: all that holds for a walk client, and the effect of q."""

from __future__ import annotations

from autograder.authoring import obligation, whole_run
from autograder.authoring.walking import client_obligations as owed
from autograder.authoring.walking.client_run import clients

sends_one_goal = obligation(1, of=clients, see="06_walk_to_a_pose#follow-task")(owed.sends_one_goal)
prints_each_feedback_in_time = obligation(1, 9, of=clients, see="05_executors#one-why")(
    owed.prints_feedback_in_time
)
says_what_was_refused = obligation(6, 7, of=clients)(owed.says_what_was_refused)
refuses_what_is_no_pose = obligation(1, of=whole_run, see="03_clients_that_survive#fix-frame")(
    owed.refuses_what_is_no_pose
)
holds_whatever_happens = owed.all_of(
    sends_one_goal, prints_each_feedback_in_time, says_what_was_refused, owed.follows(*range(1, 9))
)
