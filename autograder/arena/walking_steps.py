"""The steps of scenarios for servers that walk, by name: goals, cancels, disturbances, and waiting for what comes.

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
from humanoid_interfaces.msg import RobotState
from ros_runtime.recorded_client.goal import RESULT_TIMEOUT

ROBOT_TOPICS_TIME = 1.0  # s for the first odom and robot_state to arrive
END_TIMEOUT = 10.0  # s for the end of a goal that is cancelled, preempted or out of reach
WALK_START_TIMEOUT = 5.0  # s in which a robot begins to walk
COMING_NEAR = 15.0  # s
NEAR = 0.12  # m

MakeGoal = Callable[
    [PoseStamped, float], Any
]  # of a pose, and of what else it has: max_velocity (m/s), tolerance (m)


def walk_in_order(
    stage: Stage,
    action: str,
    action_type: Any,
    steps: Steps,
    make_goal: MakeGoal,
    others: Mapping[str, Callable[..., object]] | None = None,
) -> None:
    """Open the stage, listen to what steers the robot, and carry out the steps; `others` are verbs beside these."""
    stage.listen("cmd_vel", Twist)
    walker = _Walker(stage, stage.action(action, action_type), make_goal)
    stage.open()
    stage.wait(ROBOT_TOPICS_TIME)
    carry_out(stage, steps, {**walker.vocabulary(), **(others or {})})


class _Walker:
    """Sends goals, by name, and does things to them and to the robot."""

    def __init__(self, stage: Stage, action: ActionClient, make_goal: MakeGoal) -> None:
        self._stage, self._action, self._make_goal = stage, action, make_goal
        self._goals: dict[str, Goal] = {}
        self._poses: dict[str, PoseStamped] = {}
        self._waited_in_vain = False

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

    # -- goals: m, m, rad in odom, and m/s or m ------------------------------------------------------------------------

    def go(self, name: str, x: float, y: float, yaw: float, limit: float = 0.0) -> None:
        """Send a goal and wait for its answer."""
        self._send_pose(name, pose_at(x, y, yaw), limit).wait_for_answer()

    def go_on(self, name: str, ahead: float, left: float, turn: float, limit: float = 0.0) -> None:
        """Send a pose (m, m, rad) as seen from where the robot is now, and wait for the answer."""
        robot = self._stage.robot.state
        x = robot.x + ahead * math.cos(robot.yaw) - left * math.sin(robot.yaw)
        y = robot.y + ahead * math.sin(robot.yaw) + left * math.cos(robot.yaw)
        self.go(name, x, y, robot.yaw + turn, limit)

    def go_together(self, *goals: Sequence[Any]) -> None:
        """Send several goals, each [name, x, y, yaw, limit], in the same moment."""
        sent = [self._send_pose(name, pose_at(x, y, yaw), limit) for name, x, y, yaw, limit in goals]
        for goal in sent:
            goal.wait_for_answer()

    def ask(self, name: str, field: str, value: Any, ahead: float = 1.0) -> None:
        """Send a goal (m ahead of the origin) one `field` of which, such as 'pose.position.x', has this value."""
        pose = pose_at(ahead, 0.0, 0.0)
        goal = self._make_goal(pose, 0.0)
        *path, last = field.split(".")
        setattr(reduce(getattr, path, goal if hasattr(goal, field) else pose), last, value)
        self._send(name, pose, goal).wait_for_answer()

    def arrive(self, name: str, patience: float = RESULT_TIMEOUT) -> None:
        """Wait for the end of a goal: so long (s), unless another has kept the scenario waiting in vain."""
        goal = self._goals[name]
        if goal.accepted and not goal.wait_for_result(END_TIMEOUT if self._waited_in_vain else patience):
            self._waited_in_vain = True

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
        """Ask to cancel a goal, and wait for the answer."""
        self._goals[name].cancel().wait()

    def cancel_twice(self, name: str) -> None:
        """Ask for the same cancel two times in a row."""
        for cancel in (self._goals[name].cancel(), self._goals[name].cancel()):
            cancel.wait()

    def cancel_at_once(self, name: str, x: float, y: float, yaw: float, limit: float = 0.0) -> None:
        """Send a goal and ask to cancel it before it is answered; again, if the first request had overtaken it."""
        goal = self._send_pose(name, pose_at(x, y, yaw), limit)
        cancel = goal.cancel()
        cancel.wait()
        goal.wait_for_answer()
        if cancel.answer and cancel.answer.return_code == CancelGoal.Response.ERROR_UNKNOWN_GOAL_ID:
            goal.cancel().wait()

    # -- the robot ----------------------------------------------------------------------------------------------------

    def walk_for(self, duration: float) -> None:
        """Wait until the robot walks, and so long (s) from then on."""
        self._stage.robot.wait_for(lambda robot: robot.mode == RobotState.WALKING, WALK_START_TIMEOUT)
        self._stage.wait(duration)

    def come_near(self, name: str, distance: float) -> None:
        """Wait until the robot is within a distance (m) of where a goal sends it."""
        aim = self._poses[name].pose.position
        self._stage.robot.wait_for(
            lambda robot: math.hypot(robot.x - aim.x, robot.y - aim.y) < distance, COMING_NEAR
        )

    def settle(self, name: str) -> None:
        """Wait until the robot stands near where a goal sends it, and the goal has not ended yet, if it waits there."""
        self.come_near(name, NEAR)
        self._stage.robot.wait_for(
            lambda robot: self._goals[name].has_ended or robot.mode == RobotState.STANDING, COMING_NEAR
        )

    def cut_power(self) -> None:
        """Switch the motors off, and let the robot fall and say so."""
        robot = self._stage.robot
        robot.set_motor_power(False)
        robot.wait_for(lambda state: not state.motors_enabled)
        self._stage.wait(ROBOT_TOPICS_TIME)

    def set_up(self) -> None:
        """Put the robot on its feet again, as after a fall, and wait until it says STANDING."""
        robot = self._stage.robot
        robot.set_up()
        robot.wait_for(lambda state: state.mode == RobotState.STANDING)
        self._stage.wait(ROBOT_TOPICS_TIME)
