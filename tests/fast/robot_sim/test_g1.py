"""What only the G1 does, beside what the other tests try on both robots."""

from __future__ import annotations

import numpy as np
import pytest

from bench.robot.trial import simulate
from bench.robot.walking import Speeds
from g1 import needs_g1
from robot_sim.humanoid import Humanoid
from robot_sim.state import Mode
from robot_sim.views.view import snapshot
from robot_sim.walking.balance_gains import BalanceGains
from robot_sim.walking.planar import Frame
from ros_runtime.angles import wrap

pytestmark = needs_g1


@pytest.fixture
def robot() -> Humanoid:
    return Humanoid(robot="g1")


@pytest.mark.parametrize("case", Speeds("g1").cases(quick=True), ids=str)
def test_it_walks_as_fast_as_it_is_told(case):
    assert Speeds("g1").attempt(case)[1] == ""


def test_it_keeps_its_heading_and_counts_two_steps_a_second(robot):
    robot.reset(x=1.0, yaw=2.0)
    robot.walk_velocity(0.3, 0.0, 0.0)
    simulate(robot, 10.0)
    assert robot.mode is Mode.WALKING
    assert robot.base_pose().yaw == pytest.approx(2.0, abs=0.1)
    assert robot.steps == pytest.approx(20, abs=2)


def test_a_turn_in_short_bursts_adds_up(robot):
    """Programs that stop within their tolerance and leave it again command a fraction of a second at a time."""
    for _ in range(20):
        robot.walk_velocity(0.0, 0.0, 0.1)
        simulate(robot, 0.3)
        robot.walk_velocity(0.0, 0.0, 0.0)
        simulate(robot, 0.4)
    assert robot.base_pose().yaw == pytest.approx(20 * 0.3 * 0.1, abs=0.1)


@pytest.mark.parametrize(("x", "y", "yaw"), [(0.26, -0.03, -3.01), (0.28, 0.06, -3.0), (0.29, 0.02, -3.0)])
def test_it_comes_to_rest_for_a_program_that_corrects_every_small_turn(robot, x, y, yaw):
    simulate(robot, 1.0)
    rounds_at_rest, end = 0, robot.time + 30.0
    while rounds_at_rest < 16 and robot.time < end:  # as cancellable_walk's abort_on_acceptance does
        here = robot.base_pose()
        forward, left = Frame(*here.position[:2], here.yaw).local(x, y)
        turn = wrap(yaw - here.yaw)
        is_there = np.hypot(forward, left) <= 0.06 and abs(turn) <= 0.08
        command = (
            np.zeros(3) if is_there else np.clip([forward, left, turn], [-0.35, -0.1, -0.4], [0.35, 0.1, 0.4])
        )
        robot.walk_velocity(*command)
        rounds_at_rest = rounds_at_rest + 1 if is_there and np.hypot(*robot.data.qvel[:2]) < 0.05 else 0
        simulate(robot, 0.05)
    assert rounds_at_rest == 16


def test_without_power_all_its_parts_come_to_lie_on_the_floor(robot):
    robot.set_motor_power(False)
    for _ in range(1500):
        robot.step()
    assert all(0.0 < height < 0.4 for height in robot.data.xpos[1:, 2])


def test_power_that_comes_back_in_time_lets_it_walk_on(robot):
    robot.walk_velocity(0.2, 0.0, 0.0)
    simulate(robot, 2.0)
    steps = robot.steps
    robot.set_motor_power(False)
    simulate(robot, 0.02)
    robot.set_motor_power(True)
    simulate(robot, 3.0)
    assert robot.mode is Mode.STANDING
    assert robot.steps >= steps > 0


def test_a_resting_robot_is_simulated_because_its_walker_always_acts(robot):
    robot.may_rest = True
    simulate(robot, 1.0)
    assert not robot.is_resting


def test_what_it_cannot_do_is_refused(robot):
    with pytest.raises(ValueError, match="no gains"):
        robot.balance_gains = BalanceGains(100.0, 10.0, 100.0, 10.0, 50.0)
    with pytest.raises(ValueError, match="none of this robot"):
        robot.hold_joint("left_elbow_joint")
    with pytest.raises(ValueError, match="takes no goal"):
        robot.walk_to(1.0, 0.0, 0.0)
    with pytest.raises(ValueError, match="no scene 'table'"):
        Humanoid("table", robot="g1")
    robot.move_body(-0.1)
    robot.walk_velocity(0.2, 0.0, 0.0)
    simulate(robot, 2.0)
    assert robot.mode is Mode.WALKING


def test_its_sensors_have_the_axes_of_base_link(robot):
    simulate(robot, 2.0)
    assert robot.imu().linear_acceleration == pytest.approx([0.0, 0.0, 9.81], abs=0.6)
    weight = 9.81 * robot.model.body_mass.sum()
    assert sum(foot.read().force[2] for foot in robot.feet.values()) == pytest.approx(weight, rel=0.1)


@pytest.mark.parametrize("camera", ["track", "side", "front"])
def test_a_picture_shows_it(robot, camera):
    shown = snapshot(robot, 160, 160, camera=camera).astype(int)
    robot.model.geom_rgba[robot.model.geom_bodyid > 0, 3] = 0.0
    empty = snapshot(robot, 160, 160, camera=camera).astype(int)
    rows, columns = np.nonzero(np.abs(shown - empty).sum(axis=2) > 40)
    assert np.ptp(rows) > 60  # px of 160, from head to feet
    assert 10 < np.ptp(columns) < 100
