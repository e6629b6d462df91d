"""The hidden checks for every client of `walk_to`; the students' copy of the course does not have this module."""

from __future__ import annotations

from functools import partial

from autograder.authoring.walking import every_client
from autograder.authoring.walking.client_scenarios import ON_THE_WAY, walk

# id: scenario, title, lesson
CHECKS = {
    "gives_up_without_an_answer": (
        walk({"accepted": None}),
        "Without a goal response it ends with status 1 after 5 s",
        "03_clients_that_survive#fix-why",
    ),
    "survives_early_feedback": (
        walk({**ON_THE_WAY, "early": [6.43], "after": 1.0}),
        "Feedback that arrives before the goal response does not disturb it",
        "06_walk_to_a_pose#slow-end-why",
    ),
}

check = partial(every_client.check, among=CHECKS)
