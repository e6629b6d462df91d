"""What is done to a walking server. No expected answers here: this runs in the arena."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from autograder.arena.stage import Stage
from humanoid_interfaces.action import WalkTo

ACTION = "walk_to"
SETTLING = 1.0  # s for the first odom and robot_state to arrive
WATCHING = 3.5  # s after a cancel in which the robot must stop and stay still
AFTERWARDS = 1.5  # s after a result in which nothing more may be published
FAR = (2.0, 0.0, 0.0)  # m, m, rad
UNKNOWN_GOAL = 2  # action_msgs/CancelGoal ERROR_UNKNOWN_GOAL_ID


def _open(stage: Stage) -> None:
    stage.open(actions={ACTION: WalkTo})
    stage.wait(SETTLING)


def _goal(x: float, y: float, yaw: float, frame: str = "odom") -> dict[str, Any]:
    orientation = {"x": 0.0, "y": 0.0, "z": math.sin(yaw / 2), "w": math.cos(yaw / 2)}
    pose = {"position": {"x": x, "y": y, "z": 0.0}, "orientation": orientation}
    return {"target_pose": {"header": {"frame_id": frame}, "pose": pose}, "max_velocity": 0.0}


def walk(stage: Stage, x: float, y: float, yaw: float) -> None:
    """Walk to one pose (m, rad in odom) and watch a little longer."""
    _open(stage)
    stage.send_goal(ACTION, "walk", _goal(x, y, yaw))
    stage.wait_for_result(ACTION, "walk")
    stage.wait(AFTERWARDS)


def walk_in_turn(stage: Stage, poses: Sequence[tuple[float, float, float]]) -> None:
    """Walk to several poses, one after the other: goals 'leg 1', 'leg 2', … until one has no result."""
    _open(stage)
    for number, pose in enumerate(poses, start=1):
        stage.send_goal(ACTION, f"leg {number}", _goal(*pose))
        if not stage.wait_for_result(ACTION, f"leg {number}"):
            return


def ask_for_the_impossible(stage: Stage, frame: str) -> None:
    """Ask for a pose in a frame the server does not know, then for poses that are not numbers."""
    _open(stage)
    stage.send_goal(ACTION, "wrong frame", _goal(1.0, 0.0, 0.0, frame=frame))
    stage.send_goal(ACTION, "NaN position", _goal(math.nan, 0.0, 0.0))
    stage.send_goal(ACTION, "NaN orientation", _goal(1.0, 0.0, math.nan))


def ask_without_power(stage: Stage) -> None:
    """Cut the motors, let the robot say so, ask it to walk."""
    _open(stage)
    stage.command_robot("motor_power", on=False)
    stage.wait_for_robot(lambda robot: not robot["motors_enabled"])
    stage.wait(SETTLING)
    stage.send_goal(ACTION, "unpowered", _goal(1.0, 0.0, 0.0))


def cancel_at_the_start(stage: Stage) -> None:
    """Cancel one goal before it executes, another at its first feedback."""
    _open(stage)
    stage.send_goal(ACTION, "at once", _goal(*FAR), wait=False)
    cancel = stage.cancel(ACTION, "at once")
    stage.wait_for_goal_answer(ACTION, "at once")
    if stage.cancel_code(ACTION, cancel) == UNKNOWN_GOAL:  # the cancel overtook the goal: ask again
        stage.cancel(ACTION, "at once")
    stage.wait_for_result(ACTION, "at once", timeout=8.0)
    stage.send_goal(ACTION, "first feedback", _goal(*FAR))
    stage.wait_for_feedback(ACTION, "first feedback", 1, timeout=5.0)
    _cancel_and_watch(stage, "first feedback")


def cancel_in_mid_stride(stage: Stage, delays: Sequence[float]) -> None:
    """Cancel a goal each `delays` s after the robot began to walk; the goals are 'after 1.2 s', …"""
    _open(stage)
    for delay in delays:
        goal = f"after {delay:g} s"
        if not stage.send_goal(ACTION, goal, _ahead(stage, 2.0)):
            return
        stage.wait_for_robot(lambda robot: robot["speed"] > 0.1, timeout=5.0)
        stage.wait(delay)
        _cancel_and_watch(stage, goal)


def cancel_near_arrival(stage: Stage, distance: float) -> None:
    """Cancel when the robot is `distance` m from its goal."""
    _open(stage)
    x, y = 0.7, 0.0
    stage.send_goal(ACTION, "near", _goal(x, y, 0.0))
    stage.wait_for_robot(lambda robot: math.hypot(robot["x"] - x, robot["y"] - y) < distance, timeout=15.0)
    _cancel_and_watch(stage, "near")


def cancel_after_the_end(stage: Stage) -> None:
    """Cancel a goal that has succeeded, then send another."""
    _open(stage)
    stage.send_goal(ACTION, "first", _goal(0.3, 0.0, 0.0))
    stage.wait_for_result(ACTION, "first")
    stage.cancel(ACTION, "first")
    stage.send_goal(ACTION, "second", _goal(0.6, 0.0, 0.0))
    stage.wait_for_result(ACTION, "second")


def cancel_twice(stage: Stage) -> None:
    """Ask for the same cancel two times in a row."""
    _open(stage)
    stage.send_goal(ACTION, "walk", _goal(*FAR))
    stage.wait_for_robot(lambda robot: robot["speed"] > 0.1, timeout=5.0)
    first = stage.cancel(ACTION, "walk", wait=False)
    second = stage.cancel(ACTION, "walk", wait=False)
    stage.wait_for_cancel_answer(ACTION, first)
    stage.wait_for_cancel_answer(ACTION, second)
    stage.wait_for_result(ACTION, "walk", timeout=8.0)
    stage.wait(AFTERWARDS)


def cancel_by_a_stranger(stage: Stage) -> None:
    """A client that did not send the goal asks to cancel every goal."""
    _open(stage)
    stage.send_goal(ACTION, "walk", _goal(*FAR))
    stage.wait_for_robot(lambda robot: robot["speed"] > 0.1, timeout=5.0)
    _cancel_and_watch(stage, "walk", everything_by="stranger")


def walk_again_after_a_cancel(stage: Stage, x: float, y: float, yaw: float) -> None:
    """Cancel a goal, then walk to a pose."""
    _open(stage)
    stage.send_goal(ACTION, "canceled", _goal(*FAR))
    stage.wait_for_robot(lambda robot: robot["speed"] > 0.1, timeout=5.0)
    stage.cancel(ACTION, "canceled")
    stage.wait_for_result(ACTION, "canceled", timeout=8.0)
    stage.send_goal(ACTION, "again", _goal(x, y, yaw))
    stage.wait_for_result(ACTION, "again")
    stage.wait(AFTERWARDS)


def preempt(stage: Stage, x: float, y: float, yaw: float) -> None:
    """Send a second goal while the robot walks to the first."""
    _open(stage)
    stage.send_goal(ACTION, "old", _goal(*FAR))
    stage.wait_for_robot(lambda robot: robot["speed"] > 0.1, timeout=5.0)
    stage.wait(0.5)
    stage.send_goal(ACTION, "new", _goal(x, y, yaw))
    stage.wait_for_result(ACTION, "old", timeout=10.0)
    stage.wait_for_result(ACTION, "new")


def fall(stage: Stage, impulse: tuple[float, float, float]) -> None:
    """Knock the walking robot over (N·s in odom)."""
    _open(stage)
    stage.send_goal(ACTION, "walk", _goal(*FAR))
    stage.wait_for_robot(lambda robot: robot["speed"] > 0.1, timeout=5.0)
    stage.wait(0.5)
    stage.command_robot("push", impulse=list(impulse))
    stage.wait_for_robot(lambda robot: robot["mode"] == 3, timeout=6.0)
    stage.mark("fallen")
    stage.wait_for_result(ACTION, "walk", timeout=8.0)


def interrupt(stage: Stage) -> None:
    """Press Ctrl-C while no goal is active."""
    _open(stage)
    stage.interrupt_node()


def _ahead(stage: Stage, distance: float) -> dict[str, Any]:
    """A goal `distance` m in front of where the robot is now."""
    robot = stage.robot
    return _goal(
        robot["x"] + distance * math.cos(robot["yaw"]),
        robot["y"] + distance * math.sin(robot["yaw"]),
        robot["yaw"],
    )


def _cancel_and_watch(stage: Stage, goal: str, everything_by: str = "") -> None:
    """Cancel a goal, or every goal by another client, wait for the result and watch the robot stop."""
    if everything_by:
        stage.cancel(ACTION, by=everything_by)
    else:
        stage.cancel(ACTION, goal)
    stage.mark(f"watching {goal}")
    stage.wait_for_result(ACTION, goal, timeout=8.0)
    stage.wait(WATCHING)
