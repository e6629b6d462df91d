"""What is done to a walking server. No expected answers here: this runs in the arena."""

from __future__ import annotations

import math
from collections.abc import Sequence

from action_msgs.srv import CancelGoal

from autograder.arena.poses import pose_at
from autograder.arena.stage import STRANGER, ActionClient, Goal, Stage
from humanoid_interfaces.action import WalkTo

SETTLING = 1.0  # s for the first odom and robot_state to arrive
WATCHING = 3.5  # s after a cancel in which the robot must stop and stay still
AFTERWARDS = 1.5  # s after a result in which nothing more may be published
FAR = (2.0, 0.0, 0.0)  # m, m, rad
SOON = 8.0  # s for the result of a goal that was cancelled


def walk(stage: Stage, x: float, y: float, yaw: float) -> None:
    """Walk to one pose (m, rad in odom) and watch a little longer."""
    goal = _open(stage).send_and_wait(_pose(x, y, yaw), as_="walk")
    goal.wait_for_result()
    stage.wait(AFTERWARDS)


def walk_in_turn(stage: Stage, poses: Sequence[tuple[float, float, float]]) -> None:
    """Walk to several poses, one after the other: goals 'leg 1', 'leg 2', … until one has no result."""
    walk_to = _open(stage)
    for number, pose in enumerate(poses, start=1):
        if not walk_to.send_and_wait(_pose(*pose), as_=f"leg {number}").wait_for_result():
            return


def ask_for_the_impossible(stage: Stage, frame: str) -> None:
    """Ask for a pose in a frame the server does not know, then for poses that are not numbers."""
    walk_to = _open(stage)
    walk_to.send_and_wait(_pose(1.0, 0.0, 0.0, frame=frame), as_="wrong frame")
    walk_to.send_and_wait(_pose(math.nan, 0.0, 0.0), as_="NaN position")
    walk_to.send_and_wait(_pose(1.0, 0.0, math.nan), as_="NaN orientation")


def ask_without_power(stage: Stage) -> None:
    """Cut the motors, let the robot say so, ask it to walk."""
    walk_to = _open(stage)
    stage.robot.set_motor_power(False)
    stage.robot.wait_for(lambda robot: not robot.motors_enabled)
    stage.wait(SETTLING)
    walk_to.send_and_wait(_pose(1.0, 0.0, 0.0), as_="unpowered")


def cancel_at_the_start(stage: Stage) -> None:
    """Cancel one goal before it executes, another at its first feedback."""
    walk_to = _open(stage)
    at_once = walk_to.send(_pose(*FAR), as_="at once")
    cancel = at_once.cancel()
    cancel.wait()
    at_once.wait_for_answer()
    if cancel.answer and cancel.answer.return_code == CancelGoal.Response.ERROR_UNKNOWN_GOAL_ID:
        at_once.cancel().wait()  # the first had overtaken the goal
    at_once.wait_for_result(SOON)
    goal = walk_to.send_and_wait(_pose(*FAR), as_="first feedback")
    goal.wait_for_feedback(1, timeout=5.0)
    _cancel_and_watch(stage, goal)


def cancel_in_mid_stride(stage: Stage, delays: Sequence[float]) -> None:
    """Cancel a goal each `delays` s after the robot began to walk; the goals are 'after 1.2 s', …"""
    walk_to = _open(stage)
    for delay in delays:
        goal = walk_to.send_and_wait(_ahead(stage, 2.0), as_=f"after {delay:g} s")
        if not goal.accepted:
            return
        _let_it_walk(stage, delay)
        _cancel_and_watch(stage, goal)


def cancel_near_arrival(stage: Stage, distance: float) -> None:
    """Cancel when the robot is `distance` m from its goal."""
    x, y = 0.7, 0.0
    goal = _open(stage).send_and_wait(_pose(x, y, 0.0), as_="near")
    stage.robot.wait_for(lambda robot: math.hypot(robot.x - x, robot.y - y) < distance, timeout=15.0)
    _cancel_and_watch(stage, goal)


def cancel_after_the_end(stage: Stage) -> None:
    """Cancel a goal that has succeeded, then send another."""
    walk_to = _open(stage)
    first = walk_to.send_and_wait(_pose(0.3, 0.0, 0.0), as_="first")
    first.wait_for_result()
    first.cancel().wait()
    walk_to.send_and_wait(_pose(0.6, 0.0, 0.0), as_="second").wait_for_result()


def cancel_twice(stage: Stage) -> None:
    """Ask for the same cancel two times in a row."""
    goal = _open(stage).send_and_wait(_pose(*FAR), as_="walk")
    _let_it_walk(stage)
    for cancel in (goal.cancel(), goal.cancel()):
        cancel.wait()
    goal.wait_for_result(SOON)
    stage.wait(AFTERWARDS)


def cancel_by_a_stranger(stage: Stage) -> None:
    """A client that did not send the goal asks to cancel every goal."""
    walk_to = _open(stage)
    goal = walk_to.send_and_wait(_pose(*FAR), as_="walk")
    _let_it_walk(stage)
    walk_to.cancel_all(by=STRANGER).wait()
    _watch(stage, goal)


def walk_again_after_a_cancel(stage: Stage, x: float, y: float, yaw: float) -> None:
    """Cancel a goal, then walk to a pose."""
    walk_to = _open(stage)
    canceled = walk_to.send_and_wait(_pose(*FAR), as_="canceled")
    _let_it_walk(stage)
    canceled.cancel().wait()
    canceled.wait_for_result(SOON)
    walk_to.send_and_wait(_pose(x, y, yaw), as_="again").wait_for_result()
    stage.wait(AFTERWARDS)


def preempt(stage: Stage, x: float, y: float, yaw: float) -> None:
    """Send a second goal while the robot walks to the first."""
    walk_to = _open(stage)
    old = walk_to.send_and_wait(_pose(*FAR), as_="old")
    _let_it_walk(stage, 0.5)
    new = walk_to.send_and_wait(_pose(x, y, yaw), as_="new")
    old.wait_for_result(timeout=10.0)
    new.wait_for_result()


def fall(stage: Stage, impulse: tuple[float, float, float]) -> None:
    """Knock the walking robot over (N·s in odom)."""
    goal = _open(stage).send_and_wait(_pose(*FAR), as_="walk")
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


def _pose(x: float, y: float, yaw: float, frame: str = "odom") -> WalkTo.Goal:
    return WalkTo.Goal(target_pose=pose_at(x, y, yaw, frame), max_velocity=0.0)


def _ahead(stage: Stage, distance: float) -> WalkTo.Goal:
    """A goal `distance` m in front of where the robot is now."""
    robot = stage.robot.state
    x, y = robot.x + distance * math.cos(robot.yaw), robot.y + distance * math.sin(robot.yaw)
    return _pose(x, y, robot.yaw)


def _let_it_walk(stage: Stage, duration: float = 0.0) -> None:
    """Wait until the robot walks, and so long (s) from then on."""
    stage.robot.wait_for(lambda robot: robot.speed > 0.1, timeout=5.0)
    stage.wait(duration)


def _cancel_and_watch(stage: Stage, goal: Goal) -> None:
    goal.cancel().wait()
    _watch(stage, goal)


def _watch(stage: Stage, goal: Goal) -> None:
    """Wait for the end of a goal that is to be cancelled, and watch the robot stop."""
    goal.wait_for_result(SOON)
    stage.wait(WATCHING)
