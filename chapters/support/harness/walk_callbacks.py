"""Calls the callbacks of a student's walk server, without a robot: `walk_callbacks.py goals`, `settles` or `tells`.

It prints a line of JSON for each goal that it tried.
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

PUSHED_BACK = 0.3  # m, when it stops for the first time
SLIDES = 0.06  # m ahead, each time it stops later
MOST_COMMANDS = 150
MOST_LOOKS = 1000  # at the distance
PERIOD = 0.2  # s that a command lasts
TO_REST = 0.3  # s from the first command to stop
GOAL = 0.5  # m ahead
EARLIER_STEPS = 7  # of the robot, before the goal


def ahead(distance: float, frame: str = "base_link") -> Any:
    """Return a goal so many metres ahead."""
    goal = WalkTo.Goal()
    goal.target_pose.header.frame_id = frame
    goal.target_pose.pose.position.x = distance
    return goal


def standing(mode: int = RobotState.STANDING, steps: int = 0) -> Any:
    """Return a state of the robot."""
    return RobotState(mode=mode, motors_enabled=mode != RobotState.OFF, steps=steps)


def at(x: float) -> Any:
    """Return the pose of a robot so far along x."""
    pose = PoseStamped()
    pose.header.frame_id = "odom"
    pose.pose.position.x = x
    pose.pose.orientation.w = 1.0
    return pose


def goals() -> None:
    """Ask the goal callback about goals and states."""
    node = import_module("rejecting_walk").RejectingWalker()
    cases = {
        "1 m in base_link, while the robot stands": (at(0.0), standing(), ahead(1.0)),
        "3 m in base_link, while the robot stands": (at(0.0), standing(), ahead(3.0)),
        "a goal before the first odom": (None, standing(), ahead(1.0)),
        "a goal before the first robot_state": (at(0.0), None, ahead(1.0)),
        "a goal while the robot walks": (at(0.0), standing(RobotState.WALKING), ahead(1.0)),
        "a goal while the robot lies on the floor": (at(0.0), standing(RobotState.FALLEN), ahead(1.0)),
        "a goal while the motors are off": (at(0.0), standing(RobotState.OFF), ahead(1.0)),
        "1 m in frame odom": (at(0.0), standing(), ahead(1.0, "odom")),
        "1 m without a frame": (at(0.0), standing(), ahead(1.0, "")),
        "-1 m": (at(0.0), standing(), ahead(-1.0)),
        "0 m": (at(0.0), standing(), ahead(0.0)),
        "3.5 m": (at(0.0), standing(), ahead(3.5)),
        "NaN m": (at(0.0), standing(), ahead(math.nan)),
    }
    for case, (node.pose, node.state, goal) in cases.items():
        tell(case=case, said=_called(node.on_goal, goal))


def settles() -> None:
    """Let execute walk a toy robot, which is pushed back when it stops for the first time."""
    node = import_module("settled_walk").SettledWalker()
    robot = ToyRobot(node)
    handle = ToyHandle(robot)
    fill = node.result

    def result(*arguments: Any) -> Any:
        handle.filled_late = handle.filled_late or bool(handle.ended)
        return fill(*arguments)

    node.result = result
    returned = _called(node.execute, handle)
    tell(
        returned=returned, ended=handle.ended, final=node.pose.pose.position.x, filled_late=handle.filled_late
    )


def tells() -> None:
    """Let execute walk the same robot, and note its feedback; the node is spun, for a timer or a rate of its own."""
    node = import_module("told_walk").ToldWalker()
    for heard in list(node.subscriptions):  # the notebook's robot publishes, too
        node.destroy_subscription(heard)
    robot = ToyRobot(node)
    handle = ToyHandle(robot)
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    threading.Thread(target=executor.spin, daemon=True).start()
    returned = _called(node.execute, handle)
    executor.shutdown()
    tell(returned=returned, ended=handle.ended, told=handle.told, steps=robot.steps)


def _called(callback: Any, argument: Any) -> str:
    """What a callback returned, in words, or what it raised; as in rclpy, it may be a coroutine."""
    task = Task(callback, [argument])
    task()
    try:
        returned = task.result()
    except Exception as error:
        frames = traceback.extract_tb(error.__traceback__)
        lines = [frame.line for frame in frames if frame.filename.startswith(os.getcwd())]
        return f"{type(error).__name__}: {error}{f' in `{lines[-1]}`' if lines else ''}"
    if isinstance(returned, WalkTo.Result):
        return f"a result with final_pose {returned.final_pose.pose.position.x:.2f}"
    return getattr(returned, "name", None) or repr(returned)


class ToyRobot:
    """Moves a node's pose as its commands say; takes the place of its publisher of cmd_vel.

    Attributes:
        steps: that it has made, one for each command to walk.
    """

    def __init__(self, node: Any) -> None:
        self._node = node
        self._commands = 0
        self._stops = 0
        self._rest: threading.Timer | None = None  # while it stops
        self._looks = 0
        self.steps = 0
        self._distance_left = node.distance_left
        node.cmd_vel, node.distance_left = self, self._look
        node.pose, node.state = at(0.0), standing(steps=EARLIER_STEPS)

    @property
    def x(self) -> float:
        """Where it is, m."""
        return float(self._node.pose.pose.position.x)

    @property
    def stands(self) -> bool:
        """Whether it has come to rest."""
        return bool(self._node.state.mode == RobotState.STANDING)

    def _look(self, goal_handle: Any, start: Any) -> Any:
        self._looks += 1
        if self._looks > MOST_LOOKS:
            raise RuntimeError(f"the goal had not ended after {MOST_LOOKS} looks at the distance")
        return self._distance_left(goal_handle, start)

    def publish(self, command: Any) -> None:
        """Move for PERIOD, or come to rest soon after the first command to stop."""
        self._commands += 1
        if self._commands > MOST_COMMANDS:
            raise RuntimeError("the goal had not ended after 150 commands")
        x = self._node.pose.pose.position.x
        if command.linear.x:
            if self._rest:
                self._rest.cancel()
                self._rest = None
            self._node.pose = at(x + PERIOD * command.linear.x)
            self.steps += 1
            self._node.state = standing(RobotState.WALKING, EARLIER_STEPS + self.steps)
            return
        if not self._rest and not self.stands:
            self._rest = threading.Timer(TO_REST, self._come_to_rest)
            self._rest.start()

    def _come_to_rest(self) -> None:
        x = self._node.pose.pose.position.x
        self._node.pose = at(x - (PUSHED_BACK if self._stops == 0 else -SLIDES))
        self._node.state = standing(steps=EARLIER_STEPS + self.steps)
        self._stops += 1


class ToyHandle:
    """The goal handle, which notes feedback, and how and where the goal was ended."""

    def __init__(self, robot: ToyRobot) -> None:
        self.request = ahead(GOAL)
        self.is_cancel_requested = False
        self.is_active = True
        self.ended: list[str] = []
        self.told: list[dict[str, Any]] = []
        self.filled_late = False
        self._robot = robot

    def publish_feedback(self, feedback: Any) -> None:
        """Note what it says, and where the robot is."""
        expected = feedback.estimated_time_remaining
        self.told.append(
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
        """Note a success."""
        self._end("succeed")

    def abort(self) -> None:
        """Note an abort."""
        self._end("abort")

    def canceled(self) -> None:
        """Refuse: nobody asked for a cancel."""
        raise RuntimeError("canceled() without a cancel request")

    def _end(self, how: str) -> None:
        if self.ended:
            raise RuntimeError(f"{how}() after {self.ended[0]}")
        self.is_active = False
        self.ended.extend([how, "standing" if self._robot.stands else "walking"])


def tell(**what: Any) -> None:
    """Print a line for the check."""
    print(json.dumps(what), flush=True)


def main() -> None:
    """Run one trial."""
    sys.path.insert(0, os.getcwd())
    rclpy.init()
    {"goals": goals, "settles": settles, "tells": tells}[remove_ros_args()[1]]()
    rclpy.try_shutdown()


if __name__ == "__main__":
    main()
