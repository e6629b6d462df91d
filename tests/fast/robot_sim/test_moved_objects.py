"""A scenario removes the cup, and requests the positions of hand and cup."""

from __future__ import annotations

import json
import math
import os

import pytest

from bench.robot.trial import simulate
from robot_sim.humanoid import Humanoid
from robot_sim.ros.ground_truth import GroundTruthWriter
from robot_sim.ros.scenario_control import apply_command

ON_THE_TABLE = 0.755  # m


def test_an_object_is_moved_upright_and_at_rest() -> None:
    humanoid = Humanoid("table")
    simulate(humanoid, 0.2)
    apply_command({"do": "move_object", "name": "cup", "position": [0.5, 0.3, ON_THE_TABLE]}, humanoid, None)
    simulate(humanoid, 1.0)
    cup = humanoid.object_poses()["cup"]
    assert cup.position.tolist() == pytest.approx([0.5, 0.3, ON_THE_TABLE], abs=0.003)
    assert abs(cup.quaternion[3]) == pytest.approx(1.0, abs=1e-3)


def test_an_object_that_lies_is_put_upright() -> None:
    humanoid = Humanoid("table")
    humanoid.data.joint("cup").qpos[3:] = math.sqrt(0.5), math.sqrt(0.5), 0.0, 0.0
    humanoid.data.joint("cup").qvel[:] = 1.0
    humanoid.move_object("cup", (0.33, -0.15, ON_THE_TABLE))
    simulate(humanoid, 0.5)
    assert humanoid.data.body("cup").xmat[8] == pytest.approx(1.0, abs=1e-3)


@pytest.mark.parametrize(
    ("scene", "name", "position", "reason"),
    [
        ("flat", "cup", (0.0, 0.0, 0.1), "the scene 'flat' has no object 'cup'; it has nothing"),
        ("table", "teapot", (0.0, 0.0, 0.1), "has no object 'teapot'; it has cup"),
        ("table", "cup", (0.0, math.nan, 0.1), "expected three finite numbers"),
        ("table", "cup", (0.0, 0.1), "expected three finite numbers"),
    ],
)
def test_what_cannot_be_moved_is_refused(scene: str, name: str, position: tuple, reason: str) -> None:
    with pytest.raises(ValueError, match=reason):
        Humanoid(scene).move_object(name, position)


def test_hand_and_object_are_reported_with_each_state_of_the_robot() -> None:
    read_end, write_end = os.pipe()
    humanoid, truth = Humanoid("table"), GroundTruthWriter(write_end)
    simulate(humanoid, 0.2)
    apply_command({"do": "report_hand", "side": "r"}, humanoid, None, truth)
    apply_command({"do": "report_object", "name": "cup"}, humanoid, None, truth)
    truth.robot(humanoid, 0.0)
    os.close(write_end)
    with os.fdopen(read_end) as pipe:
        events = [json.loads(line) for line in pipe]
    assert [line["kind"] for line in events] == [
        *("hand_truth", "object_truth"),
        *("robot_truth", "hand_truth", "object_truth"),
    ]
    hand, cup = events[-2:]
    assert hand["side"] == "r"
    assert hand["position"][1] < -0.15
    assert hand["opening"] == pytest.approx(0.0, abs=0.01)
    assert hand["forces"] == pytest.approx([0.0, 0.0], abs=0.5)
    assert cup["position"] == pytest.approx([0.33, -0.15, ON_THE_TABLE], abs=0.002)
    assert cup["up"] == pytest.approx(1.0, abs=1e-3)
    assert cup["speed"] == pytest.approx(0.0, abs=0.01)
