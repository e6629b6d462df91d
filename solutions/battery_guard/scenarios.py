"""A scripted navigation, battery and robot, and Ctrl-C: what they do is data, which the checks write or draw."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from sensor_msgs.msg import BatteryState

from autograder.arena.client_stage import ClientStage
from autograder.arena.scripted_action import CancelScript, GoalScript, ScriptedAction
from autograder.arena.sequence import Steps, carry_out
from humanoid_interfaces.action import NavigateToPose
from humanoid_interfaces.msg import RobotState

SOON = 15.0  # s for a goal, or a cancel, to come

# What a server does: the fields of a GoalScript, but for
#   distances: of the feedback (m), instead of feedback
#   error_code, error_msg: of the result
#   cancel: the fields of a CancelScript
Server = Mapping[str, Any]


def in_order(
    stage: ClientStage, arguments: Sequence[str], server: Server | None, battery: float | None, steps: Steps
) -> None:
    """Start the program beside a robot that stands, carry out the steps, and await the program's end.

    The battery's level (None: nothing) is published once before it starts. `server` offers `navigate_to_pose`: from
    the start, or when a step says so; None: nobody does.
    """
    world = _World(stage, server)
    world.set_mode(RobotState.STANDING)
    if battery is not None:
        world.set_level(battery)
    if server is not None and ["offer"] not in steps:
        world.offer()
    stage.start_program(arguments)
    carry_out(stage, steps, world.vocabulary())
    stage.wait_for_end()


class _World:
    """The navigation, the battery and the robot around the program, and a person at its keyboard."""

    def __init__(self, stage: ClientStage, server: Server | None) -> None:
        self._stage, self._server = stage, server
        self._battery = stage.offer_topic("battery_state", BatteryState, latched=True)
        self._robot = stage.offer_topic("robot_state", RobotState, latched=True)
        self._navigation: ScriptedAction | None = None

    def vocabulary(self) -> dict[str, Any]:
        return {
            "battery": self.set_level,
            "robot": self.set_mode,
            "offer": self.offer,
            "wait": lambda duration: self._stage.wait_until(self._stage.has_ended, duration) or None,
            "await_goal": lambda: self._await("goals"),
            "await_answer": lambda: self._await("answers"),
            "await_cancel": lambda: self._await("cancels"),
            "press_ctrl_c": self._press_ctrl_c,
        }

    def set_level(self, percentage: float) -> None:
        self._battery.publish(BatteryState(percentage=percentage, present=True))

    def set_mode(self, mode: int) -> None:
        self._robot.publish(RobotState(mode=mode, motors_enabled=True))

    def offer(self) -> None:
        script = _goal_script(**(self._server or {}))
        self._navigation = self._stage.offer_action("navigate_to_pose", NavigateToPose, script)

    def _await(self, what: str) -> bool:
        """Wait until the server has got a goal, answered it, or got a request to cancel it; return whether it has."""

        def has_come() -> int:
            return getattr(self._navigation, what)

        self._stage.wait_until(lambda: has_come() or self._stage.has_ended(), SOON)
        return has_come() > 0

    def _press_ctrl_c(self) -> None:
        if not self._stage.has_ended():
            self._stage.interrupt_program()


def _goal_script(
    distances: Sequence[float] = (),
    error_code: int = 0,
    error_msg: str = "",
    cancel: Mapping[str, Any] | None = None,
    **others: Any,
) -> GoalScript:
    return GoalScript(
        feedback=[_feedback(distance) for distance in distances],
        result=NavigateToPose.Result(error_code=error_code, error_msg=error_msg),
        cancel=CancelScript(**(cancel or {})),
        **others,
    )


def _feedback(distance: float) -> NavigateToPose.Feedback:
    message = NavigateToPose.Feedback(status="walking", distance_remaining=distance)
    message.current_pose.header.frame_id = "odom"
    message.current_pose.pose.orientation.w = 1.0
    return message
