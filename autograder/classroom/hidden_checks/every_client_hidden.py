"""The checks that every client of `walk_to` gets and students do not see; their copy is without this module."""

from __future__ import annotations

from functools import partial

from autograder.authoring.walking import every_client
from autograder.authoring.walking.client_scenarios import ON_THE_WAY, walk

# id: scenario, title, lesson
CHECKS = {
    "gives_up_without_an_answer": (
        walk({"accepted": None}),
        "A goal that is never answered ends it with status 1 after 5 s",
        "03_clients_that_survive#fix-why",
    ),
    "survives_early_feedback": (
        walk({**ON_THE_WAY, "early": [6.43], "after": 1.0}),
        "Feedback that comes before the goal is accepted disturbs nothing",
        "06_walk_to_a_pose#slow-end-why",
    ),
}

check = partial(every_client.check, among=CHECKS)
