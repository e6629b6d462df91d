"""The forces on the feet: together they are the robot's weight, and the stance foot has most of it."""

from __future__ import annotations

import pytest

from bench.robot.trial import simulate
from robot_sim.humanoid import Humanoid
from robot_sim.model.gravity import GRAVITY
from robot_sim.model.side import SIDES, Side
from robot_sim.state import Mode


def loads(humanoid: Humanoid) -> list[float]:
    """The loads on the left and the right foot, N."""
    return [humanoid.feet[side].read().force[2] for side in SIDES]


@pytest.fixture
def humanoid() -> Humanoid:
    robot = Humanoid()
    simulate(robot, 1.0)
    return robot


@pytest.mark.parametrize("height", [None, 0.45])
def test_standing_feet_share_the_weight(height):
    humanoid = Humanoid("table")
    humanoid.reset(yaw=1.0, height=height)
    simulate(humanoid, 1.0)
    robot = humanoid.model.body("pelvis").subtreemass[0]
    assert loads(humanoid) == pytest.approx([robot * GRAVITY / 2] * 2, rel=0.02)
    for side in SIDES:
        wrench = humanoid.feet[side].read()
        assert abs(wrench.force[:2]).max() < 3.0, "nothing pulls it sideways"
        assert abs(wrench.torque[1] / wrench.force[2]) < 0.02, (
            "the centre of pressure is near the sole's centre"
        )


def test_a_walking_robot_stands_on_one_foot_at_a_time(humanoid):
    humanoid.walk_velocity(0.3, 0.0, 0.0)
    seen = []
    for _ in range(100):
        simulate(humanoid, 0.02)
        seen.append(loads(humanoid))
    assert humanoid.mode is Mode.WALKING
    assert any(left == 0.0 and right > 200.0 for left, right in seen)
    assert any(right == 0.0 and left > 200.0 for left, right in seen)


def test_the_load_equals_that_of_the_soles_touch_sensor(humanoid):
    humanoid.push((6.0, 8.0, 0.0))
    for _ in range(30):
        simulate(humanoid, 0.02)
        touch = [humanoid.data.sensor(f"{side.letter}_foot_touch").data[0] for side in SIDES]
        assert loads(humanoid) == pytest.approx(touch, rel=0.02, abs=1.0)


def test_a_push_from_the_left_loads_the_right_foot_and_causes_a_lateral_force(humanoid):
    humanoid.push((0.0, -6.0, 0.0))
    simulate(humanoid, 0.06)
    left, right = (humanoid.feet[side].read() for side in SIDES)
    assert right.force[2] > 1.2 * left.force[2]
    assert (left.force + right.force)[1] > 5.0, "the floor pushes back, to the left"


def test_a_foot_in_the_air_has_no_load():
    humanoid = Humanoid("stand")
    humanoid.data.qpos[2] += 0.3
    simulate(humanoid, 0.01)
    wrench = humanoid.feet[Side.LEFT].read()
    assert (wrench.force.tolist(), wrench.torque.tolist()) == ([0.0] * 3, [0.0] * 3)
