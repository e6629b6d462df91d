"""What is done to a navigation server. No expected answers here: this runs in the arena."""

from __future__ import annotations

import math

from autograder.arena.sequence import Steps
from autograder.arena.stage import Stage
from autograder.arena.walking_steps import APPROACH_TIMEOUT, walk_in_order
from humanoid_interfaces.action import NavigateToPose

BACKWARD, TURN = -0.2, 0.45  # m/s, rad/s of the remote control
TURNING = 2.5  # s


def in_order(stage: Stage, steps: Steps) -> None:
    """Send goals, ask to cancel, take the robot over, disturb it, wait: in the order of the steps."""
    robot = stage.robot

    def get_away(distance: float) -> None:
        """Wait until the robot is so far (m) from the origin."""
        robot.wait_for(lambda state: math.hypot(state.x, state.y) > distance, APPROACH_TIMEOUT)

    def lead_astray(back: float, side: float) -> None:
        """Take the robot over: walk it back for so long (s), turn it to a side (1 left, -1 right), and give it back."""
        robot.take_over((BACKWARD, 0.0, 0.0))
        stage.wait(back)
        robot.take_over((0.0, 0.0, side * TURN))
        stage.wait(TURNING)
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
