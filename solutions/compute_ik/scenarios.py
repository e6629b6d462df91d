"""What is done to an IK service. No expected answers here: this runs in the arena."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from autograder.arena.stage import Stage
from humanoid_interfaces.srv import ComputeIK

SERVICE = "compute_ik"
DOUBLE = 3  # rcl_interfaces/msg/ParameterType
MOVING = 1.0  # s of the robot's time for the arm from one point to the next
SETTLING = 0.3  # s of it to come to rest
OTHER_ARM_JOINTS = ("shoulder_roll", "shoulder_yaw", "wrist_yaw", "wrist_pitch", "wrist_roll")

Request = dict[str, Any]  # fields of a ComputeIK request
Questions = Mapping[str, Sequence[Request]]  # in groups, to which the checks refer by name


def ask(stage: Stage, questions: Questions) -> None:
    """Ask one group of questions after the other."""
    stage.open(services={SERVICE: ComputeIK})
    _ask(stage, questions)


def interrupt(stage: Stage, questions: Questions) -> None:
    """Ask, then press Ctrl-C."""
    ask(stage, questions)
    stage.interrupt_node()


def set_lengths(stage: Stage, questions: Questions, lengths: Mapping[str, float], then: Questions) -> None:
    """Read the parameters, ask, set them while the node runs, ask again."""
    stage.open(services={SERVICE: ComputeIK}, parameters_of=SERVICE)
    stage.call("get_parameters", {"names": list(lengths)})
    if _ask(stage, questions):
        stage.call("set_parameters", {"parameters": [_parameter(*length) for length in lengths.items()]})
        _ask(stage, then)


def move_the_arm(stage: Stage, questions: Questions) -> None:
    """Ask; at each answer to the group 'with the arm' bring the robot's left arm to it and see where the hand is."""
    stage.open(services={SERVICE: ComputeIK})
    for group, requests in questions.items():
        for request in requests:
            answer = _ask_once(stage, request)
            if answer is None:
                return
            if group == "with the arm":
                _move_to(stage, answer["shoulder"], answer["elbow"])


def _ask(stage: Stage, questions: Questions) -> bool:
    """Ask until a question is not answered: whatever hangs or is dead then will not answer the next one either."""
    return all(_ask_once(stage, request) for requests in questions.values() for request in requests)


def _ask_once(stage: Stage, request: Request) -> dict[str, Any] | None:
    return stage.response(SERVICE, stage.call(SERVICE, request))


def _parameter(name: str, value: float) -> dict[str, Any]:
    return {"name": name, "value": {"type": DOUBLE, "double_value": value}}


def _move_to(stage: Stage, shoulder: float, elbow: float) -> None:
    """Bring the left arm to the planar angles (rad), unless they are no angles, and report where it is."""
    if not (math.isfinite(shoulder) and math.isfinite(elbow)):
        return
    positions = _joint_positions(shoulder, elbow)
    stage.command_robot("move_joints", positions=positions, duration=MOVING)
    stage.wait_for_commands()
    at_rest = stage.robot["simulated"] + MOVING + SETTLING
    stage.wait_for_robot(lambda robot: robot["simulated"] >= at_rest)
    stage.command_robot("report_arm", side="l")
    stage.wait_for_commands()


def _joint_positions(shoulder: float, elbow: float) -> dict[str, float]:
    """The arm's joints (rad) for planar angles.

    At 0 the robot's arm hangs, which is -90° in the plane; and its joints turn about y, which points to the left, so
    what is counter-clockwise in the plane (x forward, y up) is negative for them.
    """
    return {
        "l_shoulder_pitch": _one_turn(-(shoulder + math.pi / 2)),
        "l_elbow": _one_turn(-elbow),
        **{f"l_{joint}": 0.0 for joint in OTHER_ARM_JOINTS},
    }


def _one_turn(angle: float) -> float:
    """The same angle between -π and π."""
    return math.remainder(angle, 2 * math.pi)
