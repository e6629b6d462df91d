"""The steps of scenarios for a walk_to server. No expected responses here: this runs in the arena."""

from __future__ import annotations

from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Odometry
from rclpy.clock import Clock

from autograder.arena.sequence import Steps
from autograder.arena.stage import Stage
from autograder.arena.walking_steps import ROBOT_TOPICS_TIME, walk_in_order
from humanoid_interfaces.action import WalkTo
from humanoid_interfaces.msg import RobotState

PERIOD = 0.05  # s between two messages of the simulated robot, the same as for odom


def in_order(stage: Stage, steps: Steps) -> None:
    """Send goals, cancel them, disturb the robot and wait, in the order of the steps."""
    walk_in_order(stage, "walk_to", WalkTo, steps, _goal)


def beside_a_played_robot(stage: Stage, steps: Steps) -> None:
    """Do the same with a simulated robot: the step ["play", odom, powered] publishes its topics for a while."""
    robot = _SimulatedRobot(stage)
    walk_in_order(stage, "walk_to", WalkTo, steps, _goal, {"play": robot.publish_for_a_while})


def _goal(pose: PoseStamped, fastest: float) -> WalkTo.Goal:
    return WalkTo.Goal(target_pose=pose, max_velocity=fastest)


class _SimulatedRobot:
    """Publishes the topics of a robot that stands at the origin."""

    def __init__(self, stage: Stage) -> None:
        self._stage = stage
        self._state = stage.offer_topic("robot_state", RobotState, latched=True)
        self._odom = stage.offer_topic("odom", Odometry)

    def publish_for_a_while(self, odom: bool, powered: bool) -> None:
        """Publish until the messages have certainly arrived."""
        for _ in range(round(2 * ROBOT_TOPICS_TIME / PERIOD)):
            self._publish_state(powered)
            if odom:
                self._publish_odom()
            self._stage.wait(PERIOD)

    def _publish_state(self, powered: bool) -> None:
        mode = RobotState.STANDING if powered else RobotState.OFF
        message = RobotState(mode=mode, motors_enabled=powered)
        message.header.stamp = Clock().now().to_msg()
        self._state.publish(message)

    def _publish_odom(self) -> None:
        message = Odometry(child_frame_id="base_link")
        message.header.frame_id, message.header.stamp = "odom", Clock().now().to_msg()
        message.pose.pose.position.z = 0.6
        self._odom.publish(message)
