"""Standing, walking and stopping."""

from __future__ import annotations

import math

import numpy as np
import pytest

from bench.robot.floor import Floor
from bench.robot.trial import base_speed, feet_midpoint, simulate
from g1 import ROBOTS
from robot_sim.humanoid import Humanoid
from robot_sim.model.dimensions import dimensions_of
from robot_sim.state import Mode
from ros_runtime.angles import wrap


@pytest.fixture
def humanoid(request: pytest.FixtureRequest) -> Humanoid:
    return Humanoid(robot=getattr(request, "param", "humanoid"))


on_both_robots = pytest.mark.parametrize("humanoid", ROBOTS, indirect=True)


def distance_walked(humanoid: Humanoid, command: tuple[float, float, float], seconds: float) -> np.ndarray:
    """Displacement (forward, left, turn) in base_link's first frame, in a steady walk."""
    humanoid.walk_velocity(*command)
    simulate(humanoid, 2.0)
    start = humanoid.base_pose()
    turned, last = 0.0, start.yaw
    for _ in range(round(seconds / 0.2)):
        simulate(humanoid, 0.2)
        turned += wrap(humanoid.base_pose().yaw - last)
        last = humanoid.base_pose().yaw
    dx, dy = (humanoid.base_pose().position - start.position)[:2]
    cos, sin = math.cos(start.yaw), math.sin(start.yaw)
    return np.array([cos * dx + sin * dy, cos * dy - sin * dx, turned])


def fastest(humanoid: Humanoid) -> float:
    """The highest speed (m/s) of the pelvis in the next second."""
    speeds = []
    for _ in range(round(1.0 / humanoid.timestep)):
        humanoid.step()
        speeds.append(base_speed(humanoid))
    return max(speeds)


@on_both_robots
def test_it_stands_still(humanoid):
    simulate(humanoid, 2.0)
    assert fastest(humanoid) < 0.02
    assert humanoid.mode is Mode.STANDING
    assert humanoid.base_pose().position[:2] == pytest.approx([0.0, 0.0], abs=0.03)
    assert humanoid.base_pose().position[2] == pytest.approx(humanoid.stance_height, abs=0.01)
    assert humanoid.up() > 0.999
    assert humanoid.steps == 0


def test_it_stands_where_it_is_reset_to(humanoid):
    humanoid.reset(x=1.0, y=-2.0, yaw=2.5)
    simulate(humanoid, 0.5)
    pose = humanoid.base_pose()
    assert pose.position[:2] == pytest.approx([1.0, -2.0], abs=0.01)
    assert pose.yaw == pytest.approx(2.5, abs=0.01)
    z, w = pose.quaternion[2:]
    assert 2 * math.atan2(z, w) == pytest.approx(2.5, abs=0.01)


@pytest.mark.parametrize("goal", [(0.6, 0.3, 0.5), (-0.4, -0.2, -0.8)])
def test_it_walks_to_a_pose_and_stands_there(humanoid, goal):
    humanoid.walk_to(*goal)
    assert not humanoid.arrived
    assert simulate(humanoid, 15.0, until=lambda: humanoid.arrived)
    simulate(humanoid, 1.0)
    assert humanoid.mode is Mode.STANDING
    assert feet_midpoint(humanoid) == pytest.approx(goal[:2], abs=0.03)
    assert humanoid.base_pose().yaw == pytest.approx(goal[2], abs=0.07)
    assert humanoid.steps >= 4


@pytest.mark.parametrize(
    "command",
    [
        (0.4, 0.0, 0.0),
        (0.02, 0.0, 0.0),
        (-0.2, 0.0, 0.0),
        (0.0, 0.12, 0.0),
        (0.0, -0.03, 0.0),
        (0.0, 0.0, 0.45),
        (0.0, 0.0, -0.1),
    ],
)
def test_it_walks_at_the_commanded_velocity(humanoid, command):
    seconds = 4.4  # ten steps
    walked = distance_walked(humanoid, command, seconds) / seconds
    assert walked == pytest.approx(command, rel=0.1, abs=0.012)
    assert humanoid.mode is Mode.WALKING


def test_it_walks_curves(humanoid):
    walked = distance_walked(humanoid, (0.25, 0.05, 0.3), 4.4)
    assert walked[2] == pytest.approx(0.3 * 4.4, rel=0.15)
    assert humanoid.base_velocity().linear[0] > 0.1


def test_a_command_repeated_at_20_hz_walks_as_far_as_one_given_once():
    once, repeated = Humanoid(), Humanoid()
    once.walk_velocity(0.3, 0.0, 0.1)
    for _ in range(100):
        repeated.walk_velocity(0.3, 0.0, 0.1)
        simulate(repeated, 0.05)
    simulate(once, 5.0)
    assert once.base_pose().position[0] > 1.0
    assert repeated.base_pose().position == pytest.approx(once.base_pose().position, abs=1e-9)


@on_both_robots
@pytest.mark.parametrize("moment", [1.0, 1.13, 1.26, 1.39])
def test_it_stops_within_two_seconds_in_any_phase_of_the_gait(humanoid, moment):
    humanoid.walk_velocity(0.35, 0.05, 0.2)
    simulate(humanoid, moment)
    assert base_speed(humanoid) > 0.1
    humanoid.stop()
    simulate(humanoid, 2.0)
    assert humanoid.mode is Mode.STANDING
    assert fastest(humanoid) < 0.05
    assert humanoid.mode is Mode.STANDING


def test_zero_velocity_is_a_stop(humanoid):
    humanoid.walk_velocity(0.3, 0.0, 0.0)
    simulate(humanoid, 2.2)
    humanoid.walk_velocity(0.0, 0.0, 0.0)
    simulate(humanoid, 2.0)
    assert humanoid.mode is Mode.STANDING
    assert base_speed(humanoid) < 0.02


@pytest.mark.parametrize("robot", ROBOTS)
def test_a_faster_command_is_walked_at_the_limit(robot):
    limit, beyond = Humanoid(robot=robot), Humanoid(robot=robot)
    limit.walk_velocity(limit.body.limits.forward, 0.0, limit.body.limits.turn)
    beyond.walk_velocity(5.0, 0.0, 9.0)
    simulate(limit, 2.0)
    simulate(beyond, 2.0)
    assert beyond.data.qpos == pytest.approx(limit.data.qpos, abs=0.0)


@pytest.mark.parametrize("command", [(math.nan, 0.0, 0.0), (0.0, math.inf, 0.0)])
def test_a_velocity_that_is_not_a_number_is_refused(humanoid, command):
    with pytest.raises(ValueError, match="expected finite numbers"):
        humanoid.walk_velocity(*command)


def test_a_pose_that_is_not_a_number_is_refused(humanoid):
    with pytest.raises(ValueError, match="expected finite numbers"):
        humanoid.walk_to(0.0, math.nan, 0.0)


@pytest.mark.parametrize("uphill", [0.0, 1.6, 3.1, -1.6])
def test_it_walks_on_a_slope_of_three_degrees(uphill):
    humanoid = Humanoid(shape=Floor(slope=math.radians(3.0), uphill=uphill).shape)
    simulate(humanoid, 0.5)
    humanoid.walk_to(1.0, 0.0, 0.0)
    assert simulate(humanoid, 15.0, until=lambda: humanoid.arrived)
    simulate(humanoid, 1.0)
    rise = humanoid.base_pose().position[2] - dimensions_of(humanoid.model).stance_height
    assert rise == pytest.approx(math.tan(math.radians(3.0)) * math.cos(uphill), abs=0.02)
    assert humanoid.mode is Mode.STANDING


def test_it_steps_over_a_bump():
    humanoid = Humanoid(shape=Floor(bumps=((0.3, 0.09, 0.01), (0.6, -0.09, 0.01))).shape)
    humanoid.walk_to(1.0, 0.0, 0.0)
    assert simulate(humanoid, 15.0, until=lambda: humanoid.arrived)
