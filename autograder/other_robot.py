"""An extra of the self-check: the checks of an exercise, with a robot that its program was not written for."""

from __future__ import annotations

from dataclasses import replace

from autograder.authoring.checks import MAY_REST, Check, Scenario
from autograder.engine.exercise import Exercise
from robot_sim.body import body_named
from ros_runtime.course_error import CourseError

WALKING_EXERCISES = (
    *("walk_to", "walk_client", "cancellable_walk", "cancel_client"),
    *("navigate_to_pose", "battery_guard"),
)


def with_robot(robot: str, exercise: Exercise) -> Exercise:
    """Return the exercise with another robot in its scenarios, and with checks that are worth no points.

    Raises:
        CourseError: the exercise cannot be checked with this robot, or packages of the robot are not installed.
    """
    if exercise.name not in WALKING_EXERCISES:
        raise CourseError(
            f"{exercise.name} cannot be checked with the robot {robot}, which only walks; the exercises are "
            f"{', '.join(WALKING_EXERCISES)}"
        )
    try:
        body_named(robot)
    except ValueError as error:
        raise CourseError(str(error)) from None
    scenarios: dict[Scenario, Scenario] = {}  # each runs once, even if several checks judge it

    def extra(check: Check) -> Check:
        on = tuple(scenarios.setdefault(each, _with_robot(robot, each)) for each in check.on)
        return replace(check, points=0, on=on)

    return replace(exercise, checks=[extra(check) for check in exercise.checks])


def _with_robot(robot: str, scenario: Scenario) -> Scenario:
    if scenario.robot is None:
        return scenario
    # without MAY_REST the clock suits a robot that moves
    options = [option for option in scenario.robot if option != MAY_REST]
    return replace(scenario, robot=("--robot", robot, *options))
