"""The steps of scenarios for a balance_controller. No expected responses here: this runs in the arena."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from rcl_interfaces.msg import Parameter as ParameterMsg
from rcl_interfaces.srv import DescribeParameters, GetParameters, SetParameters, SetParametersAtomically
from rclpy.parameter import Parameter

from autograder.arena.client_stage import ClientStage
from autograder.arena.sequence import Steps, carry_out
from autograder.arena.stage import Stage
from humanoid_interfaces.msg import BalanceGains

NODE = "balance_controller"
TOPIC = "balance_gains"
NAMES = ["kp_pitch", "kd_pitch", "kp_roll", "kd_roll", "max_torque"]
DISCOVERY_TIMEOUT = 3.0  # s for the publisher of the gains to be discovered
SETTLE_TIME = 1.7  # s for the messages after a set to arrive; longer than the model allows for a message
LATCHED_TIMEOUT = 10.0  # s for a latched message to arrive
TIME_BEFORE_PUSH = 1.0  # s of the robot's time with new gains
TIME_AFTER_PUSH = 4.0  # s of the robot's time
EXIT_TIMEOUT = 12.0  # s for a program to exit when it is started with an invalid value


def in_order(
    stage: Stage,
    steps: Steps,
    latched: bool = False,
    interrupt: bool = False,
    started_with: Mapping[str, float] | None = None,
) -> None:
    """Set gains one by one or together, read them, push the robot, subscribe late; then send SIGINT.

    `latched` is whether the subscription made before the node's start is transient local. `started_with` are the gains
    with which the node is started, if not its defaults. The checks read them.
    """
    describe = stage.service(f"{NODE}/describe_parameters", DescribeParameters)
    get = stage.service(f"{NODE}/get_parameters", GetParameters)
    set_each = stage.service(f"{NODE}/set_parameters", SetParameters)
    set_together = stage.service(f"{NODE}/set_parameters_atomically", SetParametersAtomically)
    heard = stage.listen(TOPIC, BalanceGains, latched=latched)
    stage.open()
    if not stage.poll_until(lambda: heard.publishers, DISCOVERY_TIMEOUT):
        stage.mark("nobody publishes")

    def listen(listener: str) -> None:
        stage.mark(listener)
        late = stage.listen(TOPIC, BalanceGains, latched=True, as_=listener)
        stage.wait_until(lambda: late.messages, LATCHED_TIMEOUT)

    def push(*impulse: float) -> None:
        stage.robot.wait(TIME_BEFORE_PUSH)
        stage.robot.push(impulse)
        stage.robot.wait(TIME_AFTER_PUSH)

    carry_out(
        stage,
        steps,
        {
            "describe": lambda: describe.call(DescribeParameters.Request(names=NAMES)),
            "ask": lambda: get.call(GetParameters.Request(names=NAMES)),
            "set_each": lambda values: set_each.call(SetParameters.Request(parameters=_parameters(values))),
            "set_together": lambda values: set_together.call(
                SetParametersAtomically.Request(parameters=_parameters(values))
            ),
            "settle": lambda: stage.wait(SETTLE_TIME),
            "wait": stage.wait,
            "listen": listen,
            "push": push,
        },
        {
            "describe": "describe_parameters",
            "ask": "get_parameters",
            "set_each": "set_parameters {values}",
            "set_together": "set_parameters_atomically {values}",
        },
    )
    if interrupt:
        stage.interrupt_node()


def start_with(stage: ClientStage, name: str, value: str) -> None:
    """Start the program with the value of a parameter, as typed on the command line."""
    stage.start_program(["--ros-args", "-p", f"{name}:={value}", "--"])
    stage.wait_until(stage.has_ended, EXIT_TIMEOUT)


def _parameters(values: Mapping[str, Any]) -> list[ParameterMsg]:
    """Return a parameter for each value: an integer for an int, a double for a float."""
    return [Parameter(name, value=value).to_parameter_msg() for name, value in values.items()]
