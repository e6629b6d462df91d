"""Scenarios with a scripted navigation server, battery and robot, and with Ctrl-C; the checks supply the scripts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from sensor_msgs.msg import BatteryState

from autograder.arena.client_stage import ClientStage
from autograder.arena.scripted_action import CancelScript, GoalScript
from autograder.arena.scripted_walk import Server, World, feedback
from autograder.arena.sequence import Steps
from humanoid_interfaces.action import NavigateToPose
from humanoid_interfaces.msg import RobotState


def in_order(
    stage: ClientStage, arguments: Sequence[str], server: Server | None, battery: float | None, steps: Steps
) -> None:
    """Start the program while the robot stands, carry out the steps, and wait until the program has exited.

    The battery's level (None: no message) is published once before it starts. `server` is the script of the server of
    `navigate_to_pose`, which is there from the start or from a step on; None: there is no server.
    """
    levels = stage.offer_topic("battery_state", BatteryState, latched=True)
    modes = stage.offer_topic("robot_state", RobotState, latched=True)

    def set_level(percentage: float) -> None:
        levels.publish(BatteryState(percentage=percentage, present=True))

    def set_mode(mode: int) -> None:
        modes.publish(RobotState(mode=mode, motors_enabled=True))

    set_mode(RobotState.STANDING)
    if battery is not None:
        set_level(battery)
    script = None if server is None else _goal_script(**server)
    world = World(stage, "navigate_to_pose", NavigateToPose, script)
    world.play(arguments, steps, battery=set_level, robot=set_mode)


def _goal_script(
    distances: Sequence[float] = (),
    error_code: int = 0,
    error_msg: str = "",
    cancel: Mapping[str, Any] | None = None,
    **others: Any,
) -> GoalScript:
    return GoalScript(
        feedback=[feedback(NavigateToPose, distance, status="walking") for distance in distances],
        result=NavigateToPose.Result(error_code=error_code, error_msg=error_msg),
        cancel=CancelScript(**(cancel or {})),
        **others,
    )
