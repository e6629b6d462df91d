"""What is done to an IK service. No expected answers here: this runs in the arena."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import GetParameters, SetParameters

from autograder.arena.stage import ServiceClient, Stage
from humanoid_interfaces.srv import ComputeIK
from ros_runtime.messages import from_dict

MOVING = 1.0  # s of the robot's time for the arm from one point to the next
SETTLING = 0.3  # s of it to come to rest
OTHER_ARM_JOINTS = ("shoulder_roll", "shoulder_yaw", "wrist_yaw", "wrist_pitch", "wrist_roll")

Request = dict[str, Any]  # fields of a ComputeIK request
Questions = Mapping[str, Sequence[Request]]  # in groups, to which the checks refer by name


def ask(stage: Stage, questions: Questions) -> None:
    """Ask one group of questions after the other."""
    ik = stage.service("compute_ik", ComputeIK)
    stage.open()
    _ask(ik, questions)


def interrupt(stage: Stage, questions: Questions) -> None:
    """Ask, then press Ctrl-C."""
    ask(stage, questions)
    stage.interrupt_node()


def set_lengths(stage: Stage, questions: Questions, lengths: Mapping[str, float], then: Questions) -> None:
    """Read the parameters, ask, set them while the node runs, ask again."""
    ik = stage.service("compute_ik", ComputeIK)
    parameters = stage.parameters_of(ik)
    stage.open()
    parameters.get.call(GetParameters.Request(names=list(lengths)), as_="get_parameters")
    if _ask(ik, questions):
        values = [_parameter(*length) for length in lengths.items()]
        parameters.set.call(SetParameters.Request(parameters=values), as_="set_parameters")
        _ask(ik, then)


def move_the_arm(stage: Stage, questions: Questions) -> None:
    """Ask; at each answer to the group 'with the arm' bring the robot's left arm to it and see where the hand is."""
    ik = stage.service("compute_ik", ComputeIK)
    stage.open()
    for group, requests in questions.items():
        for number, request in enumerate(requests, start=1):
            call = ik.send(from_dict(ComputeIK.Request, request), as_=f"{group} {number}")
            if not call.wait():
                return
            if group == "with the arm" and call.response:
                _move_to(stage, call.response.shoulder, call.response.elbow)


def _ask(ik: ServiceClient, questions: Questions) -> bool:
    """Ask until a question is not answered: a node that hangs or has died will not answer the next one either."""
    return all(
        ik.call(from_dict(ComputeIK.Request, request), as_=f"{group} {number}")
        for group, requests in questions.items()
        for number, request in enumerate(requests, start=1)
    )


def _parameter(name: str, value: float) -> Parameter:
    return Parameter(name=name, value=ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=value))


def _move_to(stage: Stage, shoulder: float, elbow: float) -> None:
    """Bring the left arm to the planar angles (rad), unless they are no angles, and report where it is."""
    if not (math.isfinite(shoulder) and math.isfinite(elbow)):
        return
    stage.robot.move_joints(_joint_positions(shoulder, elbow), MOVING)
    stage.robot.wait(MOVING + SETTLING)
    stage.robot.report_arm("l")
    stage.robot.wait_for_commands()


def _joint_positions(shoulder: float, elbow: float) -> dict[str, float]:
    """Return the positions (rad) of the arm's joints for planar angles.

    At 0 the robot's arm hangs, which is -90° in the plane; and its joints turn about y, which points to the left, so
    what is counter-clockwise in the plane (x forward, y up) is negative for them.
    """
    return {
        "l_shoulder_pitch": _one_turn(-(shoulder + math.pi / 2)),
        "l_elbow": _one_turn(-elbow),
        **{f"l_{joint}": 0.0 for joint in OTHER_ARM_JOINTS},
    }


def _one_turn(angle: float) -> float:
    """Return the same angle between -π and π."""
    return math.remainder(angle, 2 * math.pi)
