"""The steps of scenarios for the motor services. No expected responses here: this runs in the arena."""

from __future__ import annotations

from typing import Any

from std_srvs.srv import SetBool, Trigger

from autograder.arena.sequence import Steps, carry_out
from autograder.arena.stage import Stage
from humanoid_interfaces.msg import RobotState

SETTLE_TIME = 1.4  # s for a change to reach every node; longer than the delivery of a message may take
STEP_PAUSE = 0.2  # s from a response to the next step, so that the robot's state at the response is certain
RESPONSE_TIMEOUT = 6.0  # s, also for a response that waits for the robot's confirmation


def in_order(stage: Stage, steps: Steps, interrupt: bool = False) -> None:
    """Call both services, make the robot walk and fall, switch its power and robot_state, in the order of the steps."""
    enable, status = stage.service("enable_motors", SetBool), stage.service("get_status", Trigger)
    robot = stage.robot
    stage.open()
    stage.wait(SETTLE_TIME)

    def send(service: Any, request: Any, number: int) -> list[Any]:
        return [service.send(request) for _ in range(number)]

    def answered(calls: list[Any]) -> bool:
        came = [call.wait(RESPONSE_TIMEOUT) for call in calls]
        stage.wait(STEP_PAUSE)
        return all(came)

    def settle() -> None:
        robot.wait_for_commands()
        stage.wait(SETTLE_TIME)

    def switch_elsewhere(on: bool) -> None:
        robot.set_motor_power(on)
        settle()

    def walk(velocity: list[float]) -> None:
        robot.walk(velocity)
        robot.wait_for(lambda state: state.mode == RobotState.WALKING, timeout=5.0)
        stage.wait(SETTLE_TIME)

    def stop() -> None:
        robot.walk([0.0, 0.0, 0.0])
        robot.wait_for(lambda state: state.mode != RobotState.WALKING)
        stage.wait(SETTLE_TIME)

    def knock_over(impulse: list[float]) -> None:
        robot.knock_over(impulse)
        stage.wait(SETTLE_TIME)

    def publish_state(published: bool) -> None:
        robot.publish_robot_state(published)
        settle()

    def ask_after_switching(on: bool, switches: int, questions: int) -> bool:
        calls = send(enable, SetBool.Request(data=on), switches)
        return answered(calls + send(status, None, questions))

    carry_out(
        stage,
        steps,
        {
            "switch": lambda on, number=1: answered(send(enable, SetBool.Request(data=on), number)),
            "ask": lambda number: answered(send(status, None, number)),
            "switch_and_ask": ask_after_switching,
            "switch_elsewhere": switch_elsewhere,
            "walk": walk,
            "stop": stop,
            "knock_over": knock_over,
            "publish_state": publish_state,
            "wait": stage.wait,
            "settle": settle,
        },
        {
            "switch": "{number} × enable_motors data {on}",
            "ask": "{number} × get_status",
            "switch_and_ask": "{switches} × enable_motors data {on} and at once {questions} × get_status",
            "switch_elsewhere": "another node publishes {on} on motor_power",
            "publish_state": "the robot publishes robot_state: {published}",
            "settle": "wait for the effect",
        },
    )
    if interrupt:
        stage.interrupt_node()
