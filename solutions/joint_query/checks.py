"""What students can see being checked."""

from __future__ import annotations

import re

from autograder.authoring import events as ev
from autograder.authoring import standard
from autograder.authoring.checks import RESTING, Scenario, check, expect
from autograder.authoring.robot_topic import require_nothing_published
from autograder.authoring.transcript import Transcript

from .judging import (
    listed,
    require_names,
    require_positions,
    require_posture,
    require_refusal,
    require_success,
    robot_joints,
)

# Six joints that stand at different angles, in an order that is neither the robot's nor the alphabet's.
SIX_JOINTS = ["r_knee", "l_shoulder_roll", "r_shoulder_roll", "l_hip_pitch", "l_elbow", "r_shoulder_pitch"]
POSTURE = {
    "r_elbow": -0.9,
    "l_wrist_yaw": 0.3,
    "l_shoulder_pitch": -0.5,
    "head_pan": 0.7,
    "r_shoulder_roll": -0.8,
    "l_elbow": -1.4,
}  # rad
STRANGERS = ["tail_yaw", "l_knee", "r_wing_pitch", "head_pan", "antenna_2"]

ASK = Scenario("ask", {"names": SIX_JOINTS, "posture": POSTURE, "strangers": STRANGERS})
UNPLUGGED = Scenario(
    "ask_before_the_first_message", {"names": SIX_JOINTS}, robot=(*RESTING, "--joint-sensors-unplugged")
)
INTERRUPT = Scenario("interrupt", {"names": SIX_JOINTS}, robot=RESTING)


server_appears = standard.server_appears(
    "get_joint_positions", points=1, on=INTERRUPT, see="02_services#first-file"
)


@check(points=1, on=ASK, needs=server_appears, see="01_robot_and_graph#joints-intro")
def finds_the_joints(run: Transcript) -> None:
    """Asked for joints that the robot has, it answers success: true"""
    require_success(run.call("some joints"))


@check(points=1, on=ASK, needs=finds_the_joints, see="01_robot_and_graph#joints-run")
def keeps_the_order_asked(run: Transcript) -> None:
    """joint_state.name holds the names asked for, in the order of the request"""
    require_names(run.call("some joints"))


@check(points=2, on=ASK, needs=finds_the_joints, see="01_robot_and_graph#joints-run")
def positions_are_the_robots(run: Transcript) -> None:
    """Each position is that of the joint beside it, in radians, as the robot published it"""
    require_positions(run.call("some joints"))


@check(points=1, on=ASK, needs=positions_are_the_robots, see="01_robot_and_graph#joints-intro")
def no_names_means_all(run: Transcript) -> None:
    """Asked with an empty list, it answers with every joint once"""
    call = run.call("all joints")
    require_success(call)
    names, joints = call.response.joint_state.name, robot_joints(run)
    missing = sorted(set(joints) - set(names))
    expect(
        sorted(names) == sorted(joints),
        expected=f"all {len(joints)} joints of the robot, each once, in any order",
        observed=f"{len(names)} names; missing: {listed(missing)}",
        help="When request.names is empty, answer as if every name of the last joint_states had been asked for.",
        at=call.answered.t,
    )
    require_positions(call)


@check(points=1, on=ASK, needs=positions_are_the_robots, see="02_services#diagram")
def follows_the_robot(run: Transcript) -> None:
    """When the arms have moved, the answer has moved with them"""
    call = run.call("moved joints")
    require_success(call)
    require_posture(call, POSTURE)
    require_positions(call)


@check(points=2, on=ASK, needs=finds_the_joints, see="02_services#set-refuse-why")
def names_every_unknown_joint(run: Transcript) -> None:
    """Unknown joints: success: false and a message that names each of them; then it serves on"""
    call = run.call("strangers")
    message, joints = call.response.message, robot_joints(run)
    unknown = [name for name in STRANGERS if name not in joints]
    require_refusal(
        call,
        because=f"the robot has no {', '.join(unknown)}",
        help="The message names the unknown joints, but success is true: leave response.success False."
        if any(name in message for name in unknown)
        else "An unknown name fails the whole request: success stays false and message says which names.",
    )
    unnamed = [name for name in unknown if not re.search(rf"(?<!\w){re.escape(name)}(?!\w)", message)]
    expect(
        not unnamed,
        expected=f"a message with every unknown joint: {', '.join(unknown)}",
        observed=f"{message[:200]!r}, without {', '.join(unnamed)}",
        help="Collect the unknown names of the whole request before you answer, instead of stopping at the first.",
        at=call.answered.t,
    )
    require_success(run.call("one joint"))


@check(points=1, on=UNPLUGGED, needs=server_appears, see="02_services#m9-fix-why")
def says_when_it_knows_nothing(run: Transcript) -> None:
    """Before the first joint_states it answers success: false, also to an empty list"""
    for call in (run.call("some joints"), run.call("all joints")):
        require_nothing_published(call, ev.JointsPublished, "joint_states")
        require_nothing_published(call, ev.RobotCommanded, "joint_states")
        require_refusal(
            call,
            because="the robot has not published its joints yet",
            help="Start with no message (None) and answer success: false as long as none has arrived.",
        )


ends_cleanly = standard.ends_cleanly(
    points=1, on=INTERRUPT, needs=server_appears, see="02_services#conventions"
)
