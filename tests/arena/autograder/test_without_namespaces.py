"""Without namespaces a node shares the network with the machine; connections of other processes cost it no points."""

from __future__ import annotations

import socket
from contextlib import ExitStack

from autograder.classroom.audit.known_submission import known_submission
from autograder.engine.exercise import load_exercise
from autograder.engine.grading import GradingOptions, grade
from autograder.isolation.arena_process import Kind
from autograder.isolation.availability import Isolation
from autograder.isolation.limits import StudentLimits

EXERCISE = "battery_service"


def test_a_sound_node_has_the_visible_points_beside_other_peoples_connections() -> None:
    sound = known_submission(EXERCISE, "correct/class_based").read()
    with ExitStack() as stack:
        server = stack.enter_context(socket.create_server(("127.0.0.1", 0)))
        for _ in range(StudentLimits().tcp_sockets):
            stack.enter_context(socket.create_connection(server.getsockname()))
            stack.enter_context(server.accept()[0])
        none = GradingOptions(isolation=Isolation(Kind.NONE, "as asked for"))
        graded = grade(sound, load_exercise(EXERCISE, hidden=False), none)
    assert graded.all_passed, [check for check in graded.checks if check.status != "passed"]
    assert (graded.isolation, graded.score) == ("untrusted", graded.max_score)
