"""The steps of scenarios for a navigate_to_pose server. No expected responses here: this runs in the arena."""

from __future__ import annotations

import math

from autograder.arena.sequence import Steps
from autograder.arena.stage import Stage
from autograder.arena.units import Metres, Seconds
from autograder.arena.walking_steps import APPROACH_TIMEOUT, walk_in_order
from humanoid_interfaces.action import NavigateToPose

BACKWARD, TURN = -0.2, 0.45  # m/s and rad/s commanded by the operator
TURN_DURATION = 2.5  # s


def in_order(stage: Stage, steps: Steps) -> None:
    """Send goals, cancel them, control the robot as an operator, disturb it and wait, in the order of the steps."""
    robot = stage.robot

    def get_away(distance: Metres) -> None:
        """Wait until the robot is at a distance (m) from the origin."""
        robot.wait_for(lambda state: math.hypot(state.x, state.y) > distance, APPROACH_TIMEOUT)

    def lead_astray(back: Seconds, side: float) -> None:
        """As an operator walk the robot back for `back` s, turn it to a side (1 left, -1 right), then release it."""
        robot.take_over((BACKWARD, 0.0, 0.0))
        stage.wait(back)
        robot.take_over((0.0, 0.0, side * TURN))
        stage.wait(TURN_DURATION)
        robot.give_back()

    walk_in_order(
        stage,
        "navigate_to_pose",
        NavigateToPose,
        steps,
        lambda pose, tolerance: NavigateToPose.Goal(pose=pose, tolerance=tolerance),
        {
            "get_away": get_away,
            "lead_astray": lead_astray,
            "hold": lambda: robot.take_over((0.0, 0.0, 0.0)),
            "let_go": robot.give_back,
        },
    )
