"""The steps of scenarios for a move_arm server. No expected responses here: this runs in the arena."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence
from typing import Any

from builtin_interfaces.msg import Duration
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

from autograder.arena.sequence import Steps, carry_out
from autograder.arena.stage import Goal, Stage
from humanoid_interfaces.action import MoveArm

ROBOT_TOPICS_TIME = 1.0  # s for joint_states and joint_limits to arrive
END_TIMEOUT = 8.0  # s for the result of a goal that was cancelled, blocked or preempted
UNDER_WAY = 0.3  # rad; a joint that has turned by this is under way
MOTION_TIMEOUT = 5.0  # s for a joint to get under way
JOINTS = [
    f"{side}_{joint}"
    for side in "lr"
    for joint in (
        *("shoulder_pitch", "shoulder_roll", "shoulder_yaw", "elbow"),
        *("wrist_yaw", "wrist_pitch", "wrist_roll"),
    )
]

Points = Sequence[tuple[float, Sequence[float]]]  # s, rad


def in_order(stage: Stage, steps: Steps, watched: bool = True) -> None:
    """Send goals, cancel, block joints and wait, in the order of the steps.

    Args:
        stage: the arena.
        steps: each a verb from `_Arms.vocabulary` with its arguments.
        watched: whether to record the joints' motion and the trajectories that the server publishes.
    """
    arms = _Arms(stage)
    if watched:
        stage.listen("joint_trajectory", JointTrajectory)
    stage.open()
    if watched:
        stage.robot.report_joints(JOINTS)
        stage.robot.wait_for_commands()
    stage.wait(ROBOT_TOPICS_TIME)
    carry_out(stage, steps, arms.vocabulary())


class _Arms:
    """Sends named goals, cancels them, and blocks joints of the robot."""

    def __init__(self, stage: Stage) -> None:
        self._stage = stage
        self._action = stage.action("move_arm", MoveArm)
        self._goals: dict[str, Goal] = {}
        self._trajectories: dict[str, JointTrajectory] = {}

    def vocabulary(self) -> dict[str, Callable[..., object]]:
        return {
            "go": self.go,
            "go_together": self.go_together,
            "arrive": lambda name: self._goals[name].wait_for_result(),
            "end": lambda name: self._goals[name].wait_for_result(END_TIMEOUT),
            "be_over": self.be_over,
            "cancel": lambda name: self._goals[name].cancel().wait(),
            "get_going": self.get_going,
            "hold": self.hold,
            "hold_short": self.hold_short,
            "release": self.release,
            "release_late": self.release_late,
            "reverse_joint_states": self.reverse_joint_states,
            "unplug_joint_states": lambda: self._stage.robot.connect_joint_sensors(False),
            "wait": self._stage.wait,
            "interrupt": self._stage.interrupt_node,
        }

    # -- goals --------------------------------------------------------------------------------------------------------

    def go(
        self, name: str, arm: str, joints: Sequence[str], points: Points, goal_tolerance: float = 0.0
    ) -> None:
        """Send a goal and wait until it is accepted or rejected."""
        self._send(name, arm, joints, points, goal_tolerance).wait_for_answer()

    def go_together(self, *goals: Sequence[Any]) -> None:
        """Send several goals at once, each with the arguments of `go`."""
        for goal in [self._send(*each) for each in goals]:
            goal.wait_for_answer()

    def be_over(self, name: str) -> None:
        """Wait for the result of a goal, and at least until its last point is due."""
        self._goals[name].wait_for_result()
        self._stage.wait(max(0.0, self._due(name) - time.monotonic()))

    def _send(
        self, name: str, arm: str, joints: Sequence[str], points: Points, goal_tolerance: float = 0.0
    ) -> Goal:
        trajectory = JointTrajectory(joint_names=list(joints))
        for seconds, positions in points:
            whole = math.floor(seconds)
            after = Duration(sec=whole, nanosec=round((seconds - whole) * 1e9))
            trajectory.points.append(JointTrajectoryPoint(positions=list(positions), time_from_start=after))
        request = MoveArm.Goal(arm=arm, trajectory=trajectory, goal_tolerance=goal_tolerance)
        self._trajectories[name], self._goals[name] = trajectory, self._action.send(request, as_=name)
        return self._goals[name]

    def _due(self, name: str) -> float:
        """Return when (s) the last point of a goal is due."""
        last = self._trajectories[name].points[-1].time_from_start
        return self._goals[name].sent_at + last.sec + last.nanosec * 1e-9

    # -- the robot ----------------------------------------------------------------------------------------------------

    def get_going(self, joint: str) -> None:
        """Wait until a joint has turned by `UNDER_WAY`."""
        seen: list[float] = []

        def has_turned(angle: float) -> bool:
            seen.append(angle)
            return abs(angle - seen[0]) > UNDER_WAY

        self._stage.robot.wait_for_joint(joint, has_turned, MOTION_TIMEOUT)

    def hold(self, *joints: str) -> None:
        """Block joints at their present positions."""
        for joint in joints:
            self._stage.robot.hold_joint(joint)

    def hold_short(self, name: str, by: float, *joints: str) -> None:
        """Block joints when the last of them is within `by` rad of its last position in a goal."""
        trajectory = self._trajectories[name]
        end = trajectory.points[-1].positions[trajectory.joint_names.index(joints[-1])]
        self._stage.robot.wait_for_joint(joints[-1], lambda angle: abs(angle - end) < by, MOTION_TIMEOUT)
        self.hold(*joints)

    def release(self, *joints: str) -> None:
        """Release blocked joints."""
        for joint in joints:
            self._stage.robot.release_joint(joint)
        self._stage.robot.wait_for_commands()

    def release_late(self, name: str, late: float, *joints: str) -> None:
        """Release blocked joints `late` s after the last point of a goal was due."""
        self._stage.wait(max(0.0, self._due(name) + late - time.monotonic()))
        self.release(*joints)

    def reverse_joint_states(self) -> None:
        """Make joint_states list the joints in reversed order."""
        self._stage.robot.reverse_joint_states()
        self._stage.robot.wait_for_commands()
        self._stage.wait(ROBOT_TOPICS_TIME)
