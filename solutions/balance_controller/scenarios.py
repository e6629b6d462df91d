"""What is done to the parameters of a balance controller. No expected answers here: this runs in the arena."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import DescribeParameters, GetParameters, SetParameters, SetParametersAtomically

from autograder.arena.client_stage import ClientStage
from autograder.arena.heard_topic import HeardTopic
from autograder.arena.stage import Stage
from humanoid_interfaces.msg import BalanceGains

NODE = "balance_controller"
TOPIC = "balance_gains"
NAMES = ("kp_pitch", "kd_pitch", "kp_roll", "kd_roll", "max_torque")
MATCHING = 3.0  # s for the publisher of the gains to be found
SETTLED = 1.2  # s for what a set causes to arrive
LATE = 3.0  # s for a latched message to arrive
STANDING = 1.0  # s of the robot's time with new gains before a push
AFTERMATH = 4.0  # s of it after a push
GIVING_UP = 12.0  # s for a program to refuse what it is started with

_FIELDS = {
    bool: ("bool_value", ParameterType.PARAMETER_BOOL),
    int: ("integer_value", ParameterType.PARAMETER_INTEGER),
    float: ("double_value", ParameterType.PARAMETER_DOUBLE),
    str: ("string_value", ParameterType.PARAMETER_STRING),
}

Set = Mapping[str, Any]  # "name", "values" (their Python types are those of the parameters), "atomically"


class NodeParameters:
    """Clients of the parameter services of the student's node."""

    def __init__(self, stage: Stage) -> None:
        self._describe = stage.service(f"{NODE}/describe_parameters", DescribeParameters)
        self._get = stage.service(f"{NODE}/get_parameters", GetParameters)
        self._set = stage.service(f"{NODE}/set_parameters", SetParameters)
        self._set_atomically = stage.service(f"{NODE}/set_parameters_atomically", SetParametersAtomically)

    def describe(self) -> bool:
        """Ask what the parameters are."""
        return self._describe.call(DescribeParameters.Request(names=NAMES), as_="describe")

    def get(self, as_: str) -> bool:
        """Ask for the values."""
        return self._get.call(GetParameters.Request(names=NAMES), as_=as_)

    def set(self, one: Set) -> bool:
        """Set values, one after the other or all at once."""
        parameters = [_parameter(*item) for item in one["values"].items()]
        if one["atomically"]:
            return self._set_atomically.call(
                SetParametersAtomically.Request(parameters=parameters), as_=one["name"]
            )
        return self._set.call(SetParameters.Request(parameters=parameters), as_=one["name"])


def set_gains(stage: Stage, sets: Sequence[Set]) -> None:
    """Ask what there is, set gains, and listen to what is published meanwhile."""
    parameters = NodeParameters(stage)
    heard = stage.listen(TOPIC, BalanceGains)
    stage.open()
    _set_all(stage, parameters, heard, sets)


def interrupt(stage: Stage, sets: Sequence[Set]) -> None:
    """Set gains, then press Ctrl-C."""
    set_gains(stage, sets)
    stage.interrupt_node()


def late_listener(stage: Stage, sets: Sequence[Set]) -> None:
    """Set gains, and listen only afterwards, as a robot does that starts later."""
    parameters = NodeParameters(stage)
    stage.open()
    if parameters.get("at the start") and _set_each(stage, parameters, sets):
        stage.mark("subscribed")
        heard = stage.listen(TOPIC, BalanceGains, latched=True)
        stage.wait_until(lambda: heard.messages, LATE)


def start(stage: Stage) -> None:
    """Listen to what the node publishes by itself, and ask for its parameters."""
    parameters = NodeParameters(stage)
    heard = stage.listen(TOPIC, BalanceGains, latched=True)
    stage.open()
    if parameters.get("at the start"):
        stage.wait_until(lambda: heard.messages, LATE)
        stage.wait(SETTLED)


def push(stage: Stage, sets: Sequence[Set], impulse: Sequence[float]) -> None:
    """Set gains beside a standing robot, and push it (N·s in odom)."""
    parameters = NodeParameters(stage)
    heard = stage.listen(TOPIC, BalanceGains)
    stage.open()
    if _set_all(stage, parameters, heard, sets):
        stage.robot.wait(STANDING)
        stage.robot.push(impulse)
        stage.robot.wait(AFTERMATH)


def start_with(stage: ClientStage, name: str, value: str) -> None:
    """Start the program with a value of a parameter, as it is typed on the command line."""
    stage.start_program(["--ros-args", "-p", f"{name}:={value}", "--"])
    stage.wait_until(stage.has_ended, GIVING_UP)


def _set_all(stage: Stage, parameters: NodeParameters, heard: HeardTopic, sets: Sequence[Set]) -> bool:
    if not stage.poll_until(lambda: heard.publishers, MATCHING):
        stage.mark("nobody publishes")
    if not (parameters.describe() and parameters.get("at the start")):
        return False
    stage.wait(SETTLED)  # what is published at the start belongs to no set
    return _set_each(stage, parameters, sets) and parameters.get("at the end")


def _set_each(stage: Stage, parameters: NodeParameters, sets: Sequence[Set]) -> bool:
    """Set until there is no answer: a node that hangs or has died will not answer the next request either."""
    for one in sets:
        if not parameters.set(one):
            return False
        stage.wait(SETTLED)
    return True


def _parameter(name: str, value: Any) -> Parameter:
    field, kind = _FIELDS[type(value)]
    return Parameter(name=name, value=ParameterValue(type=kind, **{field: value}))
