"""What is done to a navigation server. No expected answers here: this runs in the arena."""

from __future__ import annotations

import math
from collections.abc import Sequence

from autograder.arena.poses import pose_at
from autograder.arena.stage import ActionClient, Stage
from humanoid_interfaces.action import NavigateToPose
from humanoid_interfaces.msg import RobotState

SETTLING = 1.0  # s for the first odom and robot_state to arrive
WATCHING = 3.5  # s after a cancel or the time limit in which the robot must stop and stay still
AFTERWARDS = 1.5  # s after a result in which nothing more may be published
FAR = (2.5, 0.0, 0.0)  # m, m, rad
SOON = 8.0  # s for the result of a goal that was cancelled


def navigate(stage: Stage, x: float, y: float, yaw: float, tolerance: float = 0.0) -> None:
    """Go to one pose (m, rad in odom) and watch a little longer."""
    goal = _open(stage).send_and_wait(_pose(x, y, yaw, tolerance), as_="go")
    goal.wait_for_result()
    stage.wait(AFTERWARDS)


def navigate_in_turn(stage: Stage, poses: Sequence[tuple[float, float, float, float]]) -> None:
    """Go to several poses (x, y, yaw, tolerance), one after the other: goals 'leg 1', 'leg 2', …"""
    navigate_to_pose = _open(stage)
    for number, pose in enumerate(poses, start=1):
        if not navigate_to_pose.send_and_wait(_pose(*pose), as_=f"leg {number}").wait_for_result():
            return


def stay(stage: Stage) -> None:
    """Ask for the very pose in which the robot stands."""
    goal = _open(stage).send_and_wait(_pose(0.0, 0.0, 0.0), as_="stay")
    goal.wait_for_result(SOON)
    stage.wait(AFTERWARDS)


def ask_for_the_impossible(stage: Stage, frame: str, tolerances: Sequence[float]) -> None:
    """Ask for a frame the server does not know, poses that are not numbers, and tolerances that are none."""
    navigate_to_pose = _open(stage)
    navigate_to_pose.send_and_wait(_pose(1.0, 0.0, 0.0, frame=frame), as_="wrong frame")
    navigate_to_pose.send_and_wait(_pose(math.nan, 0.0, 0.0), as_="NaN position")
    navigate_to_pose.send_and_wait(_pose(1.0, 0.0, math.nan), as_="NaN orientation")
    for number, tolerance in enumerate((*tolerances, math.nan), start=1):
        goal = _pose(1.0, 0.0, 0.0, tolerance)
        navigate_to_pose.send_and_wait(goal, as_=f"tolerance {number}")


def ask_without_power(stage: Stage) -> None:
    """Cut the motors, let the robot say so, ask it to go."""
    navigate_to_pose = _open(stage)
    stage.robot.set_motor_power(False)
    stage.robot.wait_for(lambda robot: not robot.motors_enabled)
    stage.wait(SETTLING)
    navigate_to_pose.send_and_wait(_pose(1.0, 0.0, 0.0), as_="unpowered")


def lead_astray(stage: Stage, x: float, y: float, back: float, turn: float) -> None:
    """On its way take the robot over: walk it back for `back` s, turn it to a side for 2.5 s, and give it back.

    Args:
        stage: the stage.
        x: of the goal, m in odom.
        y: of the goal, m in odom.
        back: how long it is walked back, s.
        turn: to the left (1) or to the right (-1).
    """
    goal = _open(stage).send_and_wait(_pose(x, y, 0.0), as_="go")
    stage.robot.wait_for(lambda robot: math.hypot(robot.x, robot.y) > 0.9, timeout=20.0)
    stage.robot.take_over((-0.2, 0.0, 0.0))
    stage.wait(back)
    stage.robot.take_over((0.0, 0.0, turn * 0.45))
    stage.wait(2.5)
    stage.robot.give_back()
    goal.wait_for_result()
    stage.wait(AFTERWARDS)


def hold(stage: Stage, x: float, after: float) -> None:
    """Stop the robot when it has gone `after` m, hold it until the goal ends, then let it go and watch."""
    goal = _open(stage).send_and_wait(_pose(x, 0.0, 0.0), as_="held")
    stage.robot.wait_for(lambda robot: math.hypot(robot.x, robot.y) > after, timeout=15.0)
    stage.robot.take_over((0.0, 0.0, 0.0))
    goal.wait_for_result(timeout=30.0 + 15.0 * x + 6.0)
    stage.robot.give_back()
    stage.wait(WATCHING + 0.5)


def cancel(stage: Stage, x: float, y: float, delays: Sequence[float]) -> None:
    """Cancel a goal each `delays` s after the robot began to move; the goals are 'after 1.2 s', …"""
    navigate_to_pose = _open(stage)
    for delay in delays:
        goal = navigate_to_pose.send_and_wait(_pose(x, y, 0.0), as_=f"after {delay:g} s")
        if not goal.accepted:
            return
        _let_it_move(stage, delay)
        goal.cancel().wait()
        goal.wait_for_result(SOON)
        stage.wait(WATCHING)


def preempt(stage: Stage, x: float, y: float, yaw: float, after: float) -> None:
    """Send a second goal `after` s after the robot began to walk to the first."""
    navigate_to_pose = _open(stage)
    old = navigate_to_pose.send_and_wait(_pose(*FAR), as_="old")
    _let_it_move(stage, after)
    new = navigate_to_pose.send_and_wait(_pose(x, y, yaw), as_="new")
    old.wait_for_result(timeout=10.0)
    new.wait_for_result()


def fall(stage: Stage, impulse: tuple[float, float, float]) -> None:
    """Knock the walking robot over (N·s in odom)."""
    goal = _open(stage).send_and_wait(_pose(*FAR), as_="walk")
    _let_it_move(stage, 0.5)
    stage.robot.knock_over(impulse)
    goal.wait_for_result(SOON)


def interrupt(stage: Stage) -> None:
    """Press Ctrl-C while no goal is active."""
    _open(stage)
    stage.interrupt_node()


def _open(stage: Stage) -> ActionClient:
    navigate_to_pose = stage.action("navigate_to_pose", NavigateToPose)
    stage.open()
    stage.wait(SETTLING)
    return navigate_to_pose


def _pose(x: float, y: float, yaw: float, tolerance: float = 0.0, frame: str = "odom") -> NavigateToPose.Goal:
    return NavigateToPose.Goal(pose=pose_at(x, y, yaw, frame), tolerance=tolerance)


def _let_it_move(stage: Stage, duration: float) -> None:
    """Wait until the robot takes steps, and so long (s) from then on."""
    stage.robot.wait_for(lambda robot: robot.mode == RobotState.WALKING, timeout=5.0)
    stage.wait(duration)
