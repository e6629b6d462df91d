"""The steps of scenarios for an IK service. No expected responses here: this runs in the arena."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from rcl_interfaces.msg import Parameter as ParameterMsg
from rcl_interfaces.srv import GetParameters, SetParameters, SetParametersAtomically
from rclpy.parameter import Parameter

from autograder.arena.sequence import Steps, carry_out
from autograder.arena.stage import Stage
from humanoid_interfaces.srv import ComputeIK

MOVE_DURATION = 1.0  # s of the robot's time, in which the arm moves from one point to the next
REST_TIME = 0.3  # s of the robot's time, in which the arm comes to rest
OTHER_ARM_JOINTS = ("shoulder_roll", "shoulder_yaw", "wrist_yaw", "wrist_pitch", "wrist_roll")

Question = Sequence[Any]  # x and y (m); optionally elbow_up, the frame, z (m)


def in_order(
    stage: Stage, steps: Steps, interrupt: bool = False, started_with: Mapping[str, float] | None = None
) -> None:
    """Call the service, move the robot's arm to the response's angles, read and set parameters; then send SIGINT.

    `started_with` are the lengths (m) that the node is started with, if not its defaults. The checks read them.
    """
    ik = stage.service("compute_ik", ComputeIK)
    parameters = stage.parameters_of(ik)
    stage.open()

    def ask(*questions: Question) -> bool:
        return ik.call_at_once([_request(*question) for question in questions])

    def move_to(*question: Any) -> bool:
        call = ik.send(_request(*question))
        if call.wait() and call.response:
            _move_to(stage, call.response.shoulder, call.response.elbow)
        return call.response is not None

    carry_out(
        stage,
        steps,
        {
            "ask": ask,
            "move_to": move_to,
            "get": lambda *names: parameters.get.call(GetParameters.Request(names=list(names))),
            "set": lambda *lengths: parameters.set.call(
                SetParameters.Request(parameters=_parameters(lengths))
            ),
            "set_together": lambda *lengths: parameters.set_together.call(
                SetParametersAtomically.Request(parameters=_parameters(lengths))
            ),
        },
        {
            "ask": "compute_ik at once for each of {questions}",
            "move_to": "move to the answer of compute_ik {question}",
            "get": "get_parameters {names}",
            "set": "set_parameters {lengths}",
            "set_together": "set_parameters_atomically {lengths}",
        },
    )
    if interrupt:
        stage.interrupt_node()


def _request(
    x: float, y: float, elbow_up: bool = False, frame: str = "shoulder", z: float = 0.0
) -> ComputeIK.Request:
    request = ComputeIK.Request(elbow_up=elbow_up)
    request.target.header.frame_id = frame
    request.target.point.x, request.target.point.y, request.target.point.z = x, y, z
    return request


def _parameters(lengths: Sequence[tuple[str, float]]) -> list[ParameterMsg]:
    return [Parameter(name, Parameter.Type.DOUBLE, length).to_parameter_msg() for name, length in lengths]


def _move_to(stage: Stage, shoulder: float, elbow: float) -> None:
    """Move the left arm to finite planar angles (rad), and report where it is."""
    if not (math.isfinite(shoulder) and math.isfinite(elbow)):
        return
    stage.robot.move_joints(_joint_positions(shoulder, elbow), MOVE_DURATION)
    stage.robot.wait(MOVE_DURATION + REST_TIME)
    stage.robot.report_arm("l")
    stage.robot.wait_for_commands()


def _joint_positions(shoulder: float, elbow: float) -> dict[str, float]:
    """Return the positions (rad, between -π and π) of the arm's joints for planar angles.

    At 0 the robot's arm hangs down, which is -90° in the plane. Its joints turn about the y axis, which points to the
    left, so a counter-clockwise angle in the plane (x forward, y up) is negative for them.
    """
    return {
        "l_shoulder_pitch": math.remainder(-(shoulder + math.pi / 2), math.tau),
        "l_elbow": math.remainder(-elbow, math.tau),
        **{f"l_{joint}": 0.0 for joint in OTHER_ARM_JOINTS},
    }
