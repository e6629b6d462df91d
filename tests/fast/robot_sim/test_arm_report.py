"""The position of an arm that the simulator reports by a pipe when a scenario requests it."""

import json
import math
import os

import pytest

from robot_sim.humanoid import Humanoid
from robot_sim.ros.ground_truth import GroundTruthWriter
from robot_sim.ros.scenario_control import apply_command

UPPER_ARM, FOREARM = 0.22, 0.30  # m: shoulder to elbow, elbow to between the fingers
STRAIGHT = ("shoulder_roll", "shoulder_yaw", "wrist_yaw", "wrist_pitch", "wrist_roll")


def arm_after(command, side):
    """The report about an arm after the robot has executed a command and come to rest."""
    read_end, write_end = os.pipe()
    humanoid, truth = Humanoid(), GroundTruthWriter(write_end)
    apply_command(command, humanoid, None, truth)
    while humanoid.time < command["duration"] + 0.5:
        humanoid.step()
    apply_command({"do": "report_arm", "side": side}, humanoid, None, truth)
    os.close(write_end)
    with os.fdopen(read_end) as pipe:
        return json.loads(pipe.readline())


@pytest.mark.parametrize(
    ("pitch", "bend", "elbow", "hand"),
    [
        (-math.pi / 2, 0.0, (UPPER_ARM, 0, 0), (UPPER_ARM + FOREARM, 0, 0)),
        (-math.pi / 2, -math.pi / 2, (UPPER_ARM, 0, 0), (UPPER_ARM, 0, FOREARM)),
        (0.0, -math.pi / 2, (0, 0, -UPPER_ARM), (FOREARM, 0, -UPPER_ARM)),
    ],
    ids=["straight ahead", "forearm up", "forearm ahead"],
)
@pytest.mark.parametrize("side", ["l", "r"])
def test_an_arm_is_reported_from_its_shoulder_with_x_ahead_and_z_up(side, pitch, bend, elbow, hand):
    positions = {f"{side}_{joint}": 0.0 for joint in STRAIGHT}
    positions |= {f"{side}_shoulder_pitch": pitch, f"{side}_elbow": bend}
    arm = arm_after({"do": "move_joints", "positions": positions, "duration": 1.0}, side)
    assert (arm["kind"], arm["side"]) == ("arm_reported", side)
    # The elbow stops 0.02 rad before the end of its range at 0, which moves the hand by 6 mm.
    assert arm["elbow"] == pytest.approx(elbow, abs=0.007)
    assert arm["hand"] == pytest.approx(hand, abs=0.007)


def test_an_arm_that_the_robot_does_not_have_is_refused():
    command = {"do": "report_arm", "side": "x"}
    with pytest.raises(ValueError, match="side 'x' is not known; expected 'l' or 'r'"):
        apply_command(command, Humanoid(), None, GroundTruthWriter(0))
