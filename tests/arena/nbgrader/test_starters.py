"""An unchanged starter notebook gets some but not all points; for a quiz it gets none."""

from pathlib import Path

import pytest

from autograder.engine.exercise import exercise_names, load_exercise
from autograder.engine.grading import GradingOptions, grade
from autograder.engine.submission import read_submission

QUIZ = "patterns"  # nothing of it is answered yet
EXERCISES = Path(__file__).resolve().parents[3] / "exercises"


@pytest.mark.parametrize("name", exercise_names())
def test_the_starter_gets_some_but_not_all_points(name):
    starter = read_submission(EXERCISES / name / f"{name}.ipynb", name)
    exercise = load_exercise(name, hidden=False)
    # With one arena at a time, scenarios are skipped if their checks depend on one that has failed.
    every = [check.id for check in exercise.checks]
    result = grade(starter, exercise, GradingOptions(jobs=1, checks_without_retry=every))
    assert result.status == "graded"
    assert result.score < result.max_score
    assert (result.score == 0) == (name == QUIZ)
