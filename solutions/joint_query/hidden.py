"""What only the instructor's grading checks."""

from __future__ import annotations

import random
from typing import Any

from autograder.authoring.call import Call
from autograder.authoring.checks import RESTING, Scenario, check, expect
from autograder.authoring.transcript import Transcript

from .checks import (
    SIX_JOINTS,
    UNPLUGGED,
    finds_the_joints,
    follows_the_robot,
    keeps_the_order_asked,
    names_every_unknown_joint,
    positions_are_the_robots,
    says_when_it_knows_nothing,
)
from .judging import (
    listed,
    require_names,
    require_positions,
    require_posture,
    require_refusal,
    require_reversed,
    require_success,
)

# Where the robot can hold its arms and head without touching itself: rad.
RANGES = {
    "head_pan": (-1.0, 1.0),
    "head_tilt": (-0.5, 0.7),
    "l_shoulder_pitch": (-0.9, 0.5),
    "l_shoulder_roll": (0.3, 1.0),
    "l_elbow": (-2.1, -1.7),
    "l_wrist_yaw": (-0.8, 0.8),
    "r_shoulder_pitch": (-0.9, 0.5),
    "r_shoulder_roll": (-1.0, -0.3),
    "r_elbow": (-1.5, -0.4),
    "r_wrist_pitch": (-0.8, 0.8),
}
BURST = 8


def _inputs(random: random.Random) -> dict[str, Any]:
    """A posture, several lists for one moment, a list for another order on the topic, and parts of names."""
    joints = random.sample(sorted(RANGES), len(RANGES))
    return {
        "posture": {name: round(random.uniform(*RANGES[name]), 3) for name in joints},
        "burst": {
            f"at once, {number}": [f"{random.choice('lr')}_hip_yaw", *random.sample(sorted(RANGES), 3)]
            for number in range(1, BURST + 1)
        },
        "reordered": random.sample(sorted(RANGES), 5),
        "parts": {
            f"part {part}": [part]
            for part in random.sample(["elbow", "l_shoulder", "hip_", "wrist_yaw", "head", "r_"], 2)
        },
    }


EVERY_WAY = Scenario("ask_in_every_way", _inputs)
OTHER_NAMESPACE = Scenario("ask_once", {"names": SIX_JOINTS}, robot=RESTING, namespace="/lab_7/robot")


def _require_positions_as_asked(call: Call) -> None:
    require_success(call)
    require_names(call)
    require_positions(call)


@check(
    points=1,
    on=UNPLUGGED,
    needs=[positions_are_the_robots, says_when_it_knows_nothing],
    see="02_services#m9-fix-why",
)
def recovers_when_the_sensors_appear(run: Transcript) -> None:
    """Once the first message has come, it answers with it"""
    call = run.call("after the first message")
    run.told("joint_sensors", before=call.sent.t, connected=True)
    _require_positions_as_asked(call)


@check(
    points=1,
    on=EVERY_WAY,
    needs=[keeps_the_order_asked, follows_the_robot],
    see="01_robot_and_graph#joints-intro",
)
def answers_in_any_posture(run: Transcript) -> None:
    """Whatever the posture, it answers with it"""
    call = run.call("in a posture")
    _require_positions_as_asked(call)
    require_posture(call, run.params["posture"])


@check(points=1, on=EVERY_WAY, needs=finds_the_joints, see="02_services#m4-why")
def answers_every_request(run: Transcript) -> None:
    """Eight different requests at once are all answered, each with its own joints and within 2 s"""
    for name in run.params["burst"]:
        call = run.call(name)
        returned, wanted = call.response.joint_state.name, call.request.names
        expect(
            call.latency <= 2.0,
            expected="every answer within 2 s",
            observed=f"one took {call.latency:.2f} s",
            help="Answer from memory: the callback must not sleep or wait for the next message.",
            at=call.sent.t,
        )
        expect(
            sorted(returned) == sorted(wanted),
            expected=f"an answer to {', '.join(wanted)}",
            observed=f"joints of another request: {listed(returned)}",
            help="Requests may be served at the same time: keep what belongs to one in local variables, not in self.",
            at=call.answered.t,
        )


@check(points=1, on=EVERY_WAY, needs=answers_in_any_posture, see="01_robot_and_graph#joints-run")
def looks_joints_up_by_name(run: Transcript) -> None:
    """When joint_states lists the joints in another order, each position is still its own joint's"""
    call = run.call("in another order")
    _require_positions_as_asked(call)
    require_reversed(call)


@check(points=1, on=EVERY_WAY, needs=names_every_unknown_joint, see="02_services#set-refuse-why")
def takes_no_joint_for_another(run: Transcript) -> None:
    """A part of a joint's name is no joint: success: false"""
    for name in run.params["parts"]:
        require_refusal(
            run.call(name),
            because="that is only a part of joints' names",
            help="Compare whole names: `name in positions` with a dictionary, not `part in name` with a string.",
        )


@check(points=1, on=OTHER_NAMESPACE, needs=positions_are_the_robots, see="01_robot_and_graph#names-why")
def works_in_any_namespace(run: Transcript) -> None:
    """Started in another namespace, it serves the robot there"""
    call = run.call("some joints")
    require_success(call)
    require_positions(call)
