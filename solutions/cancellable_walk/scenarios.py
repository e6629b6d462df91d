"""The steps of scenarios for a walk_to server. No expected responses here: this runs in the arena."""

from __future__ import annotations

from geometry_msgs.msg import PoseStamped

from autograder.arena.sequence import Steps
from autograder.arena.stage import Stage
from autograder.arena.walking_steps import walk_in_order
from humanoid_interfaces.action import WalkTo


def in_order(stage: Stage, steps: Steps) -> None:
    """Send goals, cancel them, disturb the robot and wait, in the order of the steps."""
    walk_in_order(stage, "walk_to", WalkTo, steps, _goal)


def _goal(pose: PoseStamped, fastest: float) -> WalkTo.Goal:
    return WalkTo.Goal(target_pose=pose, max_velocity=fastest)
