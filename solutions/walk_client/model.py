"""What must hold for every run of the walk client: what it sends, cancels and prints, and how it exits."""

from __future__ import annotations

from autograder.authoring import obligation, whole_run
from autograder.authoring.walking import client_obligations as owed
from autograder.authoring.walking.client_run import clients

sends_one_goal = obligation(1, 12, of=clients, see="06_walk_to_a_pose#client-intro")(owed.sends_one_goal)
prints_each_feedback = obligation(2, of=clients, see="06_walk_to_a_pose#field-why")(owed.prints_each_feedback)
refuses_what_is_no_pose = obligation(11, of=whole_run, see="03_clients_that_survive#fix-frame")(
    owed.refuses_what_is_no_pose
)
asks_for_its_result = obligation(12, of=clients, see="06_walk_to_a_pose#late-why")(owed.asks_for_its_result)
holds_whatever_happens = owed.all_of(
    sends_one_goal, asks_for_its_result, prints_each_feedback, owed.follows(*range(3, 11), 12)
)
