"""The steps of scenarios for walking servers: goals, cancels, disturbances, and waits.

walk_in_order(stage, "walk_to", WalkTo, steps, lambda pose, limit: WalkTo.Goal(target_pose=pose))
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from functools import reduce
from typing import Any

from action_msgs.srv import CancelGoal
from geometry_msgs.msg import PoseStamped, Twist

from autograder.arena.poses import pose_at
from autograder.arena.sequence import Steps, carry_out
from autograder.arena.stage import STRANGER, ActionClient, Goal, Stage
from autograder.arena.units import Metres, Radians, Seconds
from humanoid_interfaces.msg import RobotState
from ros_runtime.recorded_client.goal import RESULT_TIMEOUT

ROBOT_TOPICS_TIME = 1.0  # s for the first odom and robot_state to arrive
END_TIMEOUT = 10.0  # s for the end of a goal that is cancelled, preempted or out of reach
WALK_START_TIMEOUT = 5.0  # s in which a robot begins to walk
APPROACH_TIMEOUT = 15.0  # s
NEAR = 0.12  # m

# from a pose and the action's limit: max_velocity (m/s) or tolerance (m)
MakeGoal = Callable[[PoseStamped, float], Any]


def walk_in_order(
    stage: Stage,
    action: str,
    action_type: Any,
    steps: Steps,
    make_goal: MakeGoal,
    others: Mapping[str, Callable[..., object]] | None = None,
) -> None:
    """Open the stage, record cmd_vel, and carry out the steps; `others` are further verbs for the steps."""
    stage.listen("cmd_vel", Twist)
    walker = _Walker(stage, stage.action(action, action_type), make_goal)
    stage.open()
    stage.wait(ROBOT_TOPICS_TIME)
    carry_out(stage, steps, {**walker.vocabulary(), **(others or {})})


class _Walker:
    """Carries out steps: sends, cancels and awaits goals by name, and disturbs the robot."""

    def __init__(self, stage: Stage, action: ActionClient, make_goal: MakeGoal) -> None:
        self._stage, self._action, self._make_goal = stage, action, make_goal
        self._goals: dict[str, Goal] = {}
        self._poses: dict[str, PoseStamped] = {}
        self._a_goal_timed_out = False

    def vocabulary(self) -> dict[str, Callable[..., object]]:
        return {
            "go": self.go,
            "go_on": self.go_on,
            "go_together": self.go_together,
            "ask": self.ask,
            "cancel": self.cancel,
            "cancel_twice": self.cancel_twice,
            "cancel_at_once": self.cancel_at_once,
            "cancel_all": lambda: self._action.cancel_all(by=STRANGER).wait(),
            "walk_for": self.walk_for,
            "come_near": self.come_near,
            "settle": self.settle,
            "hear_of": lambda name: self._goals[name].wait_for_feedback(1, WALK_START_TIMEOUT),
            "arrive": self.arrive,
            "end": self.end,
            "wait": self._stage.wait,
            "knock_over": lambda *impulse: self._stage.robot.knock_over(impulse),
            "cut_power": self.cut_power,
            "set_up": self.set_up,
            "interrupt": self._stage.interrupt_node,
        }

    # -- goals: poses in odom, and a limit in m/s or m -----------------------------------------------------------------

    def go(self, name: str, x: Metres, y: Metres, yaw: Radians, limit: float = 0.0) -> None:
        """Send a goal and wait for its answer."""
        self._send_pose(name, pose_at(x, y, yaw), limit).wait_for_answer()

    def go_on(self, name: str, ahead: Metres, left: Metres, turn: Radians) -> None:
        """Send a goal relative to the robot's present pose (m, m, rad), and wait for the answer."""
        robot = self._stage.robot.state
        x = robot.x + ahead * math.cos(robot.yaw) - left * math.sin(robot.yaw)
        y = robot.y + ahead * math.sin(robot.yaw) + left * math.cos(robot.yaw)
        self.go(name, x, y, robot.yaw + turn)

    def go_together(self, *goals: Sequence[Any]) -> None:
        """Send several goals, each [name, x, y, yaw, limit], without waiting in between; then await the answers."""
        sent = [self._send_pose(name, pose_at(x, y, yaw), limit) for name, x, y, yaw, limit in goals]
        for goal in sent:
            goal.wait_for_answer()

    def ask(self, name: str, field: str, value: Any, ahead: Metres = 1.0) -> None:
        """Send a goal `ahead` m in front of the origin with `field`, such as 'pose.position.x', set to `value`."""
        pose = pose_at(ahead, 0.0, 0.0)
        goal = self._make_goal(pose, 0.0)
        *path, last = field.split(".")
        setattr(reduce(getattr, path, goal if hasattr(goal, field) else pose), last, value)
        self._send(name, pose, goal).wait_for_answer()

    def arrive(self, name: str, patience: Seconds = RESULT_TIMEOUT) -> None:
        """Wait `patience` s for the end of a goal, or END_TIMEOUT if an earlier goal has missed its timeout."""
        goal = self._goals[name]
        if goal.accepted and not goal.wait_for_result(END_TIMEOUT if self._a_goal_timed_out else patience):
            self._a_goal_timed_out = True

    def end(self, name: str) -> None:
        """Wait for the end of a goal that was cancelled, preempted or put out of reach."""
        self._goals[name].wait_for_result(END_TIMEOUT)

    def _send_pose(self, name: str, pose: PoseStamped, limit: float) -> Goal:
        return self._send(name, pose, self._make_goal(pose, limit))

    def _send(self, name: str, pose: PoseStamped, goal: Any) -> Goal:
        self._goals[name], self._poses[name] = self._action.send(goal, as_=name), pose
        return self._goals[name]

    # -- cancels ------------------------------------------------------------------------------------------------------

    def cancel(self, name: str) -> None:
        """Request to cancel a goal, and wait for the answer."""
        self._goals[name].cancel().wait()

    def cancel_twice(self, name: str) -> None:
        """Request the same cancel twice in a row."""
        for cancel in (self._goals[name].cancel(), self._goals[name].cancel()):
            cancel.wait()

    def cancel_at_once(self, name: str, x: Metres, y: Metres, yaw: Radians, limit: float = 0.0) -> None:
        """Send a goal and request to cancel it before it is answered; repeat if the cancel arrived before the goal."""
        goal = self._send_pose(name, pose_at(x, y, yaw), limit)
        cancel = goal.cancel()
        cancel.wait()
        goal.wait_for_answer()
        if cancel.answer and cancel.answer.return_code == CancelGoal.Response.ERROR_UNKNOWN_GOAL_ID:
            goal.cancel().wait()

    # -- the robot ----------------------------------------------------------------------------------------------------

    def walk_for(self, duration: Seconds) -> None:
        """Wait until the robot walks, then for `duration` s."""
        self._stage.robot.wait_for(lambda robot: robot.mode == RobotState.WALKING, WALK_START_TIMEOUT)
        self._stage.wait(duration)

    def come_near(self, name: str, distance: Metres) -> None:
        """Wait until the robot is within a distance (m) of where a goal sends it."""
        aim = self._poses[name].pose.position
        self._stage.robot.wait_for(
            lambda robot: math.hypot(robot.x - aim.x, robot.y - aim.y) < distance, APPROACH_TIMEOUT
        )

    def settle(self, name: str) -> None:
        """Wait until the robot is near a goal's pose, and then until it stands or the goal has ended."""
        self.come_near(name, NEAR)
        self._stage.robot.wait_for(
            lambda robot: self._goals[name].has_ended or robot.mode == RobotState.STANDING, APPROACH_TIMEOUT
        )

    def cut_power(self) -> None:
        """Switch the motors off, and leave time for the fall and for robot_state to be received."""
        robot = self._stage.robot
        robot.set_motor_power(False)
        robot.wait_for(lambda state: not state.motors_enabled)
        self._stage.wait(ROBOT_TOPICS_TIME)

    def set_up(self) -> None:
        """Put the robot on its feet again, as after a fall, and wait until its mode is STANDING."""
        robot = self._stage.robot
        robot.set_up()
        robot.wait_for(lambda state: state.mode == RobotState.STANDING)
        self._stage.wait(ROBOT_TOPICS_TIME)
