"""A scenario holds a joint against its motor, and requests joint positions."""

from __future__ import annotations

import json
import os

import pytest

from bench.robot.trial import simulate
from robot_sim.arms.joint_trajectory import JointTrajectory, Waypoint
from robot_sim.humanoid import Humanoid
from robot_sim.ros.ground_truth import GroundTruthWriter
from robot_sim.ros.scenario_control import apply_command
from robot_sim.state import Mode

HELD = "l_elbow"


def place(humanoid: Humanoid, joint: str) -> float:
    return float(humanoid.data.joint(joint).qpos[0])


@pytest.mark.parametrize("joint", ["l_elbow", "r_elbow", "l_shoulder_pitch", "r_wrist_pitch"])
def test_a_held_joint_stays_and_the_robot_stands(joint: str) -> None:
    humanoid = Humanoid()
    simulate(humanoid, 0.5)
    before = place(humanoid, joint)
    apply_command({"do": "hold_joint", "joint": joint}, humanoid, None)
    humanoid.move_joints(JointTrajectory((joint,), (Waypoint(2.0, (before - 0.8,)),)))
    simulate(humanoid, 4.0)
    assert place(humanoid, joint) == pytest.approx(before, abs=0.1)
    assert humanoid.mode is Mode.STANDING
    apply_command({"do": "release_joint", "joint": joint}, humanoid, None)
    simulate(humanoid, 2.0)
    assert place(humanoid, joint) == pytest.approx(before - 0.8, abs=0.02)
    assert humanoid.mode is Mode.STANDING


def test_a_joint_held_on_its_way_stops_there_while_the_others_go_on() -> None:
    humanoid = Humanoid()
    humanoid.move_joints(JointTrajectory((HELD, "l_wrist_yaw"), (Waypoint(4.0, (-2.1, 0.5)),)))
    simulate(humanoid, 1.0)
    caught = place(humanoid, HELD)
    humanoid.hold_joint(HELD)
    simulate(humanoid, 4.0)
    assert place(humanoid, HELD) == pytest.approx(caught, abs=0.1)
    assert place(humanoid, "l_wrist_yaw") == pytest.approx(0.5, abs=0.02)
    assert humanoid.mode is Mode.STANDING


def test_a_robot_with_a_held_joint_does_not_rest() -> None:
    humanoid = Humanoid()
    humanoid.may_rest = True
    humanoid.hold_joint(HELD)
    simulate(humanoid, 3.0)
    assert not humanoid.is_resting
    humanoid.release_joint(HELD)
    simulate(humanoid, 3.0)
    assert humanoid.is_resting


def test_a_reset_releases_held_joints() -> None:
    humanoid = Humanoid()
    humanoid.hold_joint(HELD)
    humanoid.step()
    humanoid.reset()
    humanoid.move_joints(JointTrajectory((HELD,), (Waypoint(1.0, (-1.5,)),)))
    simulate(humanoid, 1.5)
    assert place(humanoid, HELD) == pytest.approx(-1.5, abs=0.02)


def test_legs_and_fingers_are_not_held() -> None:
    humanoid = Humanoid()
    for joint in ("l_knee", "l_finger_1", "tail"):
        with pytest.raises(ValueError, match=f"joint '{joint}' cannot be held"):
            humanoid.hold_joint(joint)
    with pytest.raises(ValueError, match="grip is 0"):
        humanoid.hold_joint(HELD, 0)


def test_the_requested_joints_are_reported_with_each_state_of_the_robot() -> None:
    read_end, write_end = os.pipe()
    humanoid, truth = Humanoid(), GroundTruthWriter(write_end)
    truth.robot(humanoid, 0.0)
    apply_command({"do": "report_joints", "names": [HELD, "r_wrist_roll"]}, humanoid, None, truth)
    truth.robot(humanoid, 0.0)
    os.close(write_end)
    with os.fdopen(read_end) as pipe:
        events = [json.loads(line) for line in pipe]
    assert [line["kind"] for line in events] == ["robot_truth", "joints_truth", "robot_truth", "joints_truth"]
    there = {joint: place(humanoid, joint) for joint in (HELD, "r_wrist_roll")}
    assert events[-1]["positions"] == pytest.approx(there, abs=1e-4)
    assert set(events[-1]["velocities"]) == {HELD, "r_wrist_roll"}
