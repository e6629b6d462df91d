"""Programs that were written for the course's robot pass their checks on the G1."""

from __future__ import annotations

import pytest

from autograder.classroom.audit.known_submission import known_submission
from autograder.engine.exercise import load_exercise
from autograder.engine.grading import GradingOptions, grade
from autograder.isolation.availability import available_isolation
from autograder.other_robot import with_robot
from g1 import needs_g1

pytestmark = [
    needs_g1,
    pytest.mark.skipif(
        not available_isolation().trusted, reason=f"no namespaces here: {available_isolation().reason}"
    ),
]


@pytest.mark.parametrize("name", ["walk_to", "cancellable_walk", "navigate_to_pose"])
def test_a_correct_server_walks_a_robot_that_it_has_never_seen(name: str) -> None:
    exercise = with_robot("g1", load_exercise(name, hidden=False))
    submission = known_submission(name, "correct/threads_and_sleep").read()
    result = grade(submission, exercise, GradingOptions(jobs=2))
    assert {verdict.id: verdict.observed for verdict in result.checks if verdict.status != "passed"} == {}


def test_a_faulty_server_fails_on_it_too() -> None:
    exercise = with_robot("g1", load_exercise("cancellable_walk", hidden=False))
    submission = known_submission("cancellable_walk", "faulty/ignores_cancel").read()
    result = grade(submission, exercise, GradingOptions(jobs=2))
    assert "cancels_in_mid_stride" in {verdict.id for verdict in result.checks if verdict.status == "failed"}
