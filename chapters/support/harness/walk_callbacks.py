"""Calls the callbacks of a student's walk server with a simple model of the robot, and prints the outcome as JSON.

walk_callbacks.py goals      calls the goal callback for goals that it must accept or reject
walk_callbacks.py settling   calls execute, to see when and where it ends the goal
walk_callbacks.py feedback   calls execute, to see its feedback
"""

from __future__ import annotations

import json
import math
import os
import sys
import threading
import time
import traceback
from importlib import import_module
from typing import Any

import rclpy
from geometry_msgs.msg import PoseStamped
from rclpy.executors import SingleThreadedExecutor
from rclpy.task import Task
from rclpy.utilities import remove_ros_args

from humanoid_interfaces.action import WalkTo
from humanoid_interfaces.msg import RobotState

PUSH_DISTANCE = 0.3  # m that the robot is pushed back when it stops for the first time
SLIDE_DISTANCE = 0.13  # m that it slides ahead each time it stops after that, past the goal
MAX_COMMANDS = 150
MAX_DISTANCE_READS = 1000
PERIOD = 0.2  # s that the robot moves for each command
STOP_DURATION = 0.3  # s from the first command to stop until the robot stands
GOAL = 0.5  # m ahead
EARLIER_STEPS = 7  # made before the goal


def ahead(distance: float, frame: str = "base_link") -> Any:
    """Return a goal at this distance ahead, in m."""
    goal = WalkTo.Goal()
    goal.target_pose.header.frame_id = frame
    goal.target_pose.pose.position.x = distance
    return goal


def robot_state(mode: int = RobotState.STANDING, steps: int = 0) -> Any:
    """Return a state of the robot, by default standing."""
    return RobotState(mode=mode, motors_enabled=mode != RobotState.OFF, steps=steps)


def at(x: float) -> Any:
    """Return the pose of a robot at x, in m."""
    pose = PoseStamped()
    pose.header.frame_id = "odom"
    pose.pose.position.x = x
    pose.pose.orientation.w = 1.0
    return pose


def goals() -> None:
    """Call the goal callback with different goals and states of the robot."""
    node = import_module("rejecting_walk").RejectingWalker()
    cases = {
        "1 m in base_link, while the robot stands": (at(0.0), robot_state(), ahead(1.0)),
        "3 m in base_link, while the robot stands": (at(0.0), robot_state(), ahead(3.0)),
        "a goal before the first odom": (None, robot_state(), ahead(1.0)),
        "a goal before the first robot_state": (at(0.0), None, ahead(1.0)),
        "a goal while the robot walks": (at(0.0), robot_state(RobotState.WALKING), ahead(1.0)),
        "a goal while the robot lies on the floor": (at(0.0), robot_state(RobotState.FALLEN), ahead(1.0)),
        "a goal while the motors are off": (at(0.0), robot_state(RobotState.OFF), ahead(1.0)),
        "1 m in frame odom": (at(0.0), robot_state(), ahead(1.0, "odom")),
        "1 m without a frame": (at(0.0), robot_state(), ahead(1.0, "")),
        "-1 m": (at(0.0), robot_state(), ahead(-1.0)),
        "0 m": (at(0.0), robot_state(), ahead(0.0)),
        "3.5 m": (at(0.0), robot_state(), ahead(3.5)),
        "NaN m": (at(0.0), robot_state(), ahead(math.nan)),
    }
    for case, (node.pose, node.state, goal) in cases.items():
        print_json(case=case, returned=_call_in_words(node.on_goal, goal))


def settling() -> None:
    """Let execute walk the toy robot, which is pushed back when it stops for the first time."""
    node = import_module("settled_walk").SettledWalker()
    robot = ToyRobot(node)
    handle = ToyGoalHandle(robot)
    fill = node.result

    def result(*arguments: Any) -> Any:
        handle.filled_late = handle.filled_late or bool(handle.ended)
        return fill(*arguments)

    node.result = result
    returned = _call_in_words(node.execute, handle)
    print_json(
        returned=returned, ended=handle.ended, final=node.pose.pose.position.x, filled_late=handle.filled_late
    )


def feedback() -> None:
    """Let execute walk the toy robot, and record its feedback.

    The node is spun, because the student's lines may wait by a timer or a rate.
    """
    node = import_module("told_walk").ToldWalker()
    # otherwise it would receive the data of the notebook's robot
    for subscription in list(node.subscriptions):
        node.destroy_subscription(subscription)
    robot = ToyRobot(node)
    handle = ToyGoalHandle(robot)
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    threading.Thread(target=executor.spin, daemon=True).start()
    returned = _call_in_words(node.execute, handle)
    executor.shutdown()
    print_json(returned=returned, ended=handle.ended, feedback=handle.feedback, steps=robot.steps)


def _call_in_words(callback: Any, argument: Any) -> str:
    """Call a callback, which may be a coroutine, and describe what it returned or raised."""
    task = Task(callback, [argument])
    task()
    try:
        returned = task.result()
    except Exception as error:
        frames = traceback.extract_tb(error.__traceback__)
        own = [frame for frame in frames if frame.filename.startswith(os.getcwd())]
        where = f" in line {own[-1].lineno} (`{own[-1].line}`)" if own else ""
        return f"{type(error).__name__}: {error}{where}"
    if isinstance(returned, WalkTo.Result):
        return f"a result with final_pose {returned.final_pose.pose.position.x:.2f}"
    return getattr(returned, "name", None) or repr(returned)


class ToyRobot:
    """A model of the robot that replaces the node's publisher of cmd_vel and changes the node's pose and state.

    Attributes:
        steps: how many steps it has made, one for each command to walk.
    """

    def __init__(self, node: Any) -> None:
        self._node = node
        self._commands = 0
        self._stops = 0
        self._stop_timer: threading.Timer | None = None  # while the robot comes to rest
        self._distance_reads = 0
        self.steps = 0
        self._distance_left = node.distance_left
        node.cmd_vel, node.distance_left = self, self._read_distance
        node.pose, node.state = at(0.0), robot_state(steps=EARLIER_STEPS)

    @property
    def x(self) -> float:
        """The robot's position in m."""
        return float(self._node.pose.pose.position.x)

    @property
    def stands(self) -> bool:
        """Whether the robot has come to rest."""
        return bool(self._node.state.mode == RobotState.STANDING)

    def _read_distance(self, goal_handle: Any, start: Any) -> Any:
        self._distance_reads += 1
        if self._distance_reads > MAX_DISTANCE_READS:
            raise RuntimeError(f"the goal had not ended after {MAX_DISTANCE_READS} calls of distance_left()")
        return self._distance_left(goal_handle, start)

    def publish(self, command: Any) -> None:
        """Move for PERIOD, or come to rest soon after the first command to stop."""
        self._commands += 1
        if self._commands > MAX_COMMANDS:
            raise RuntimeError(f"the goal had not ended after {MAX_COMMANDS} commands")
        x = self._node.pose.pose.position.x
        if command.linear.x:
            if self._stop_timer:
                self._stop_timer.cancel()
                self._stop_timer = None
            self._node.pose = at(x + PERIOD * command.linear.x)
            self.steps += 1
            self._node.state = robot_state(RobotState.WALKING, EARLIER_STEPS + self.steps)
            return
        if not self._stop_timer and not self.stands:
            self._stop_timer = threading.Timer(STOP_DURATION, self._come_to_rest)
            self._stop_timer.start()

    def _come_to_rest(self) -> None:
        x = self._node.pose.pose.position.x
        self._node.pose = at(x - (PUSH_DISTANCE if self._stops == 0 else -SLIDE_DISTANCE))
        self._node.state = robot_state(steps=EARLIER_STEPS + self.steps)
        self._stops += 1


class ToyGoalHandle:
    """A goal handle that records the feedback, and how the goal was ended while the robot stood or walked."""

    def __init__(self, robot: ToyRobot) -> None:
        self.request = ahead(GOAL)
        self.is_cancel_requested = False
        self.is_active = True
        self.ended: list[str] = []
        self.feedback: list[dict[str, Any]] = []
        self.filled_late = False
        self._robot = robot

    def publish_feedback(self, feedback: Any) -> None:
        """Record the feedback, and where the robot is at that moment."""
        expected = feedback.estimated_time_remaining
        self.feedback.append(
            {
                "t": time.monotonic(),
                "frame": feedback.current_pose.header.frame_id,
                "x": feedback.current_pose.pose.position.x,
                "left": feedback.distance_remaining,
                "steps": feedback.steps_taken,
                "seconds": expected.sec + expected.nanosec / 1e9,
                "robot_x": self._robot.x,
                "robot_stands": self._robot.stands,
            }
        )

    def succeed(self) -> None:
        """Record that the goal succeeded."""
        self._end("succeed")

    def abort(self) -> None:
        """Record that the goal was aborted."""
        self._end("abort")

    def canceled(self) -> None:
        """Raise an error as rclpy does, because no cancel was requested."""
        raise RuntimeError("canceled() without a cancel request")

    def _end(self, how: str) -> None:
        if self.ended:
            raise RuntimeError(f"{how}() after {self.ended[0]}")
        self.is_active = False
        self.ended.extend([how, "standing" if self._robot.stands else "walking"])


def print_json(**what: Any) -> None:
    """Print these values as a line of JSON for the check."""
    print(json.dumps(what), flush=True)


def main() -> None:
    """Run the trial that the argument names."""
    sys.path.insert(0, os.getcwd())
    rclpy.init()
    {"goals": goals, "settling": settling, "feedback": feedback}[remove_ros_args()[1]]()
    rclpy.try_shutdown()


if __name__ == "__main__":
    main()
