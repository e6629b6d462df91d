"""A scenario applies a lateral force to the robot, lowers it, and requests the loads on its feet."""

from __future__ import annotations

import json
import os

import pytest

from bench.robot.trial import simulate
from robot_sim.humanoid import Humanoid
from robot_sim.ros.ground_truth import GroundTruthWriter
from robot_sim.ros.scenario_control import apply_command
from robot_sim.state import Mode

CROUCH, STANCE = 0.45, 0.60  # m
FORCE = 20.0  # N


def loads(humanoid: Humanoid) -> list[dict]:
    """The loads in the ground truth: one at the request, and one with the robot's next state."""
    read_end, write_end = os.pipe()
    truth = GroundTruthWriter(write_end)
    truth.robot(humanoid, 0.0)
    apply_command({"do": "report_feet"}, humanoid, None, truth)
    truth.robot(humanoid, 0.0)
    os.close(write_end)
    with os.fdopen(read_end) as pipe:
        events = [json.loads(line) for line in pipe]
    assert [line["kind"] for line in events] == ["robot_truth", "feet_truth", "robot_truth", "feet_truth"]
    return [line for line in events if line["kind"] == "feet_truth"]


def test_the_requested_feet_are_reported_with_each_state_of_the_robot() -> None:
    humanoid = Humanoid()
    simulate(humanoid, 1.0)
    for sample in loads(humanoid):
        assert sample["left"] == pytest.approx(186, abs=4)
        assert sample["right"] == pytest.approx(186, abs=4)


@pytest.mark.parametrize("side", [-1, 1])
@pytest.mark.parametrize("height", [CROUCH, STANCE])
def test_a_lateral_force_loads_the_feet_unevenly_until_it_ends(side: int, height: float) -> None:
    humanoid = Humanoid()
    humanoid.reset(height=height)
    simulate(humanoid, 1.0)
    apply_command({"do": "push", "impulse": [0.0, 3 * side * FORCE, 0.0], "duration": 3.0}, humanoid, None)
    simulate(humanoid, 0.3)
    for _ in range(25):
        sample = loads(humanoid)[0]
        heavy, light = (sample["left"], sample["right"])[::side]
        assert 20 < light < 0.4 * heavy
        assert humanoid.mode is Mode.STANDING
        simulate(humanoid, 0.1)
    simulate(humanoid, 1.0)
    sample = loads(humanoid)[0]
    assert sample["left"] == pytest.approx(sample["right"], rel=0.1)
    assert (humanoid.mode, humanoid.steps) == (Mode.STANDING, 0)


def test_a_scenario_lowers_the_robot_until_the_next_command() -> None:
    humanoid = Humanoid()
    apply_command({"do": "move_body", "rate": -0.1}, humanoid, None)
    assert simulate(humanoid, 2.0, until=lambda: humanoid.base_pose().position[2] < 0.53)
    apply_command({"do": "move_body", "rate": 0.0}, humanoid, None)
    simulate(humanoid, 1.0)
    assert humanoid.base_pose().position[2] == pytest.approx(0.52, abs=0.015)
