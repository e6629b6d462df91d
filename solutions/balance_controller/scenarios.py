"""What is done to the parameters of a balance controller. No expected answers here: this runs in the arena."""

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
MATCHING = 3.0  # s for the publisher of the gains to be found
SETTLED = 1.7  # s for what a set causes to arrive; longer than the model lets a message be on its way
LATCHED_TIME = 10.0  # s for a latched message to arrive
STANDING = 1.0  # s of the robot's time with new gains before a push
AFTERMATH = 4.0  # s of it after a push
GIVING_UP = 12.0  # s for a program to refuse what it is started with


def in_order(
    stage: Stage,
    steps: Steps,
    latched: bool = False,
    interrupt: bool = False,
    started_with: Mapping[str, float] | None = None,
) -> None:
    """Set gains one by one or together, ask for them, push the robot, listen late; then press Ctrl-C.

    `latched` is how the topic is listened to from before the node's start. `started_with` are the gains that the node
    is started with, if not the usual ones: the model has to know.
    """
    describe = stage.service(f"{NODE}/describe_parameters", DescribeParameters)
    get = stage.service(f"{NODE}/get_parameters", GetParameters)
    set_each = stage.service(f"{NODE}/set_parameters", SetParameters)
    set_together = stage.service(f"{NODE}/set_parameters_atomically", SetParametersAtomically)
    heard = stage.listen(TOPIC, BalanceGains, latched=latched)
    stage.open()
    if not stage.poll_until(lambda: heard.publishers, MATCHING):
        stage.mark("nobody publishes")

    def listen(listener: str) -> None:
        stage.mark(listener)
        late = stage.listen(TOPIC, BalanceGains, latched=True, as_=listener)
        stage.wait_until(lambda: late.messages, LATCHED_TIME)

    def push(*impulse: float) -> None:
        stage.robot.wait(STANDING)
        stage.robot.push(impulse)
        stage.robot.wait(AFTERMATH)

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
            "settle": lambda: stage.wait(SETTLED),
            "wait": stage.wait,
            "listen": listen,
            "push": push,
        },
    )
    if interrupt:
        stage.interrupt_node()


def start_with(stage: ClientStage, name: str, value: str) -> None:
    """Start the program with a value of a parameter, as it is typed on the command line."""
    stage.start_program(["--ros-args", "-p", f"{name}:={value}", "--"])
    stage.wait_until(stage.has_ended, GIVING_UP)


def _parameters(values: Mapping[str, Any]) -> list[ParameterMsg]:
    """Return a parameter for each value, an integer or a double as the value's Python type says."""
    return [Parameter(name, value=value).to_parameter_msg() for name, value in values.items()]
