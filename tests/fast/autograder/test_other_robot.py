"""An exercise's checks with another robot: the same scenarios, without points."""

from __future__ import annotations

import pytest
from typer.testing import CliRunner

from autograder.authoring.checks import MAY_REST, Scenario
from autograder.engine.exercise import Exercise, load_exercise
from autograder.other_robot import WALKING_EXERCISES, with_robot
from course_cli.app import app
from g1 import needs_g1
from robot_sim.ros.options import parse_options
from ros_runtime.course_error import CourseError


def scenarios_of(exercise: Exercise) -> set[Scenario]:
    return {scenario for check in exercise.checks for scenario in check.on}


@needs_g1
@pytest.mark.parametrize("name", WALKING_EXERCISES)
def test_every_robot_of_the_scenarios_is_the_other_one_and_no_check_has_points(name):
    exercise = load_exercise(name, hidden=False)
    extra = with_robot("g1", exercise)
    assert extra.max_score() == 0 < exercise.max_score()
    assert len(scenarios_of(extra)) == len(scenarios_of(exercise))
    for check, usual in zip(extra.checks, exercise.checks, strict=True):
        for scenario, before in zip(check.on, usual.on, strict=True):
            if before.robot is None:
                assert scenario is before
            else:
                assert parse_options(scenario.robot).robot == "g1"
                assert MAY_REST not in scenario.robot


@pytest.mark.parametrize(
    ("robot", "name", "said"),
    [
        ("g1", "move_arm", "move_arm cannot be checked with the robot g1, which only walks"),
        ("g2", "walk_to", "'g2' is not known"),
    ],
)
def test_another_exercise_or_an_unknown_robot_is_refused(robot, name, said):
    with pytest.raises(CourseError, match=said):
        with_robot(robot, load_exercise(name, hidden=False))
    ran = CliRunner().invoke(app("audit"), ["audit", name, "--robot", robot])
    assert (ran.exit_code, said in " ".join(ran.output.split())) == (2, True)
