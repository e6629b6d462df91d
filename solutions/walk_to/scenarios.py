"""What is done to a walking server. No expected answers here: this runs in the arena."""

from __future__ import annotations

import math
from collections.abc import Sequence

from geometry_msgs.msg import Quaternion, Twist
from nav_msgs.msg import Odometry
from rclpy.clock import Clock

from autograder.arena.poses import pose_at
from autograder.arena.stage import ActionClient, Stage
from humanoid_interfaces.action import WalkTo
from humanoid_interfaces.msg import RobotState

SETTLING = 1.0  # s for the first odom and robot_state to arrive
AFTERWARDS = 1.5  # s after a result in which the robot must stand and nothing more may be published
BETWEEN = 0.5  # s from one goal's result to the next goal
FAR = (2.0, 0.0, 0.0)  # m, m, rad
PERIOD = 0.05  # s between two messages of the played robot, as odom's
SOON = 8.0  # s for the result of a goal that cannot be reached any more


def walk(stage: Stage, x: float, y: float, yaw: float, max_velocity: float) -> None:
    """Walk to one pose (m, rad in odom; m/s), listen to what steers the robot, and watch a little longer."""
    stage.listen("cmd_vel", Twist)
    goal = _open(stage).send_and_wait(_goal(x, y, yaw, max_velocity), as_="walk")
    goal.wait_for_result()
    stage.wait(AFTERWARDS)


def walk_in_turn(stage: Stage, legs: Sequence[tuple[float, float, float, float]]) -> None:
    """Walk to several poses (m, m, rad, m/s): goals 'leg 1', 'leg 2', … until one has no result."""
    walk_to = _open(stage)
    for number, leg in enumerate(legs, start=1):
        if not walk_to.send_and_wait(_goal(*leg), as_=f"leg {number}").wait_for_result():
            return
        stage.wait(BETWEEN)


def ask_for_the_impossible(stage: Stage, frame: str) -> None:
    """Ask for a pose in a frame that the server does not know, and for numbers that mean nothing."""
    walk_to = _open(stage)
    nowhere = _goal(1.0, 0.0, 0.0)
    nowhere.target_pose.pose.orientation = Quaternion(x=0.0, y=0.0, z=0.0, w=0.0)
    goals = {
        "wrong frame": _goal(1.0, 0.0, 0.0, frame=frame),
        "NaN position": _goal(math.nan, 0.0, 0.0),
        "NaN orientation": _goal(1.0, 0.0, math.nan),
        "zero quaternion": nowhere,
        "negative velocity": _goal(1.0, 0.0, 0.0, max_velocity=-0.2),
        "NaN velocity": _goal(1.0, 0.0, 0.0, max_velocity=math.nan),
    }
    for name, goal in goals.items():
        walk_to.send_and_wait(goal, as_=name)


def ask_before_the_first_odom(stage: Stage) -> None:
    """Play a robot that stands and says so; ask before its first odom, and again after some."""
    robot = _PlayedRobot(stage)
    walk_to = _open(stage)
    robot.publish_for_a_while(odom=False, powered=True)
    walk_to.send_and_wait(_goal(1.0, 0.0, 0.0), as_="before odom")
    robot.publish_for_a_while(odom=True, powered=True)
    walk_to.send_and_wait(_goal(1.0, 0.0, 0.0), as_="after odom")


def ask_without_power(stage: Stage) -> None:
    """Play a robot whose motors are off; ask, switch them on, ask again."""
    robot = _PlayedRobot(stage)
    walk_to = _open(stage)
    robot.publish_for_a_while(odom=True, powered=False)
    walk_to.send_and_wait(_goal(1.0, 0.0, 0.0), as_="without power")
    robot.publish_for_a_while(odom=True, powered=True)
    walk_to.send_and_wait(_goal(1.0, 0.0, 0.0), as_="with power")


def interfere(stage: Stage) -> None:
    """While the robot walks as fast as the server likes: ask to cancel, then send a second goal."""
    walk_to = _open(stage)
    goal = walk_to.send_and_wait(_goal(*FAR), as_="walk")
    _let_it_walk(stage, 0.5)
    goal.cancel().wait()
    walk_to.send_and_wait(_goal(0.0, 0.5, 0.0), as_="second")
    stage.wait(BETWEEN)


def fall(stage: Stage, impulse: tuple[float, float, float], max_velocity: float) -> None:
    """Knock the walking robot over (N·s in odom)."""
    goal = _open(stage).send_and_wait(_goal(*FAR, max_velocity=max_velocity), as_="walk")
    _let_it_walk(stage, 0.5)
    stage.robot.knock_over(impulse)
    goal.wait_for_result(SOON)


def interrupt(stage: Stage) -> None:
    """Press Ctrl-C while no goal is active."""
    _open(stage)
    stage.interrupt_node()


def _open(stage: Stage) -> ActionClient:
    walk_to = stage.action("walk_to", WalkTo)
    stage.open()
    stage.wait(SETTLING)
    return walk_to


def _goal(x: float, y: float, yaw: float, max_velocity: float = 0.0, frame: str = "odom") -> WalkTo.Goal:
    return WalkTo.Goal(target_pose=pose_at(x, y, yaw, frame), max_velocity=max_velocity)


def _let_it_walk(stage: Stage, duration: float) -> None:
    """Wait until the robot walks, and so long (s) from then on."""
    stage.robot.wait_for(lambda robot: robot.speed > 0.1, timeout=5.0)
    stage.wait(duration)


class _PlayedRobot:
    """Publishes what a robot that stands at the origin publishes."""

    def __init__(self, stage: Stage) -> None:
        self._stage = stage
        self._state = stage.offer_topic("robot_state", RobotState, latched=True)
        self._odom = stage.offer_topic("odom", Odometry)

    def publish_for_a_while(self, *, odom: bool, powered: bool) -> None:
        """Publish long enough for the last messages to have arrived."""
        for _ in range(round(2 * SETTLING / PERIOD)):
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
