"""The physics of a resting robot is not integrated, and its published state does not show that."""

import math

import numpy as np
import pytest

from bench.robot.trial import simulate
from bench.robot.trial_humanoid import TrialHumanoid
from robot_sim.arms.joint_trajectory import JointTrajectory, Waypoint
from robot_sim.model.side import Side

SETTLED = 2.5  # s, more than it takes to come to rest after a reset
SEEN = 1e-5  # rad, m, rad/s, m/s: a hundredth of the gyro's noise, and half a thousandth of a degree


def standing(scene="flat", may_rest=True, seed=3):
    humanoid = TrialHumanoid(scene, seed=seed)
    humanoid.may_rest = may_rest
    return humanoid


def rests(humanoid):
    """Whether a step changes nothing but the time, to the last bit."""

    def state():
        data = humanoid.data
        return data.qpos.tobytes() + data.qvel.tobytes() + data.qacc.tobytes() + data.sensordata.tobytes()

    before, time = state(), humanoid.time
    humanoid.step()
    assert humanoid.time == pytest.approx(time + humanoid.timestep)
    return state() == before


def told(humanoid):
    """The state from which messages are made, without battery and time."""
    pose, velocity, joints = humanoid.base_pose(), humanoid.base_velocity(), humanoid.joint_state()
    return np.concatenate(
        [
            *(pose.position, pose.quaternion, velocity.linear, velocity.angular),
            *(joints.position, joints.velocity),
            [humanoid.up(), float(humanoid.mode), float(humanoid.motors_enabled), float(humanoid.steps)],
        ]
    )


@pytest.mark.parametrize("scene", ["flat", "stand"])
def test_a_resting_robot_has_the_same_state_as_an_integrated_one(scene):
    resting, integrated = standing(scene), standing(scene, may_rest=False)
    for _ in range(200):  # 20 s
        simulate(resting, 0.1)
        simulate(integrated, 0.1)
        assert resting.time == integrated.time
        # on the stand a weld creeps by a µrad a second
        assert told(resting) == pytest.approx(told(integrated), abs=SEEN if scene == "flat" else 1e-4)
        assert resting.joint_state().effort == pytest.approx(integrated.joint_state().effort, abs=1e-2)  # N·m
        ours, theirs = resting.imu(), integrated.imu()
        # the same noise, to 1 % of its deviation
        assert ours.angular_velocity == pytest.approx(theirs.angular_velocity, abs=1e-5)
        assert ours.linear_acceleration == pytest.approx(theirs.linear_acceleration, abs=5e-4)
        assert ours.orientation == pytest.approx(theirs.orientation, abs=SEEN if scene == "flat" else 1e-4)
        assert resting.battery.percentage == pytest.approx(integrated.battery.percentage, rel=1e-6)
        assert resting.battery.current == pytest.approx(integrated.battery.current, rel=1e-4)
        assert resting.battery.voltage == pytest.approx(integrated.battery.voltage, rel=1e-6)
    assert rests(resting)
    assert not rests(integrated)
    drained = 1 - resting.battery.percentage
    assert drained == pytest.approx(1 - integrated.battery.percentage, rel=1e-4)
    assert drained > 1e-4


def test_each_reading_of_the_sensors_has_new_noise():
    humanoid = standing()
    simulate(humanoid, SETTLED)
    first = humanoid.imu()
    simulate(humanoid, 0.02)
    assert rests(humanoid)
    assert not np.array_equal(first.angular_velocity, humanoid.imu().angular_velocity)


def test_a_robot_that_may_not_rest_does_not_rest():
    humanoid = standing(may_rest=False)
    simulate(humanoid, SETTLED)
    assert not rests(humanoid)


def test_a_robot_does_not_rest_before_it_stands_still():
    humanoid = standing()
    simulate(humanoid, 0.5)
    assert not rests(humanoid)


COMMANDS = {
    "walk_velocity": lambda h: h.walk_velocity(0.2, 0.0, 0.0),
    "walk_to": lambda h: h.walk_to(
        0.3, 0.1, 0.2
    ),  # straight ahead the last digit of the heading decides which foot
    "motor_power": lambda h: h.set_motor_power(False),
    "push": lambda h: h.push((3.0, 0.0, 0.0)),
    "move_body": lambda h: h.move_body(-0.1),
    "crouch_to": lambda h: h.crouch_to(0.5),
    "balance_gains": lambda h: setattr(h, "balance_gains", h.balance_gains),
    "move_joints": lambda h: h.move_joints(JointTrajectory(("l_elbow",), (Waypoint(1.0, (-1.0,)),))),
    "open_hand": lambda h: h.open_hand(Side.LEFT, 0.05),
    "empty battery": lambda h: h.battery.set_percentage(0.0),
    "reset": lambda h: h.reset(),
}


@pytest.mark.parametrize("command", COMMANDS)
def test_a_command_ends_the_rest_at_once_and_nothing_jumps(command):
    resting, integrated = standing(), standing(may_rest=False)
    for humanoid in (resting, integrated):
        simulate(humanoid, SETTLED)
    assert rests(resting)
    assert not rests(integrated)
    for humanoid in (resting, integrated):
        COMMANDS[command](humanoid)
    if command == "empty battery":
        resting.step()  # at the end of which the motors go off
        integrated.step()
    assert not rests(resting)
    assert not rests(integrated)
    for _ in range(100):  # 0.5 s
        resting.step()
        integrated.step()
        assert told(resting) == pytest.approx(told(integrated), abs=1e-3)


@pytest.mark.parametrize("command", [lambda h: h.walk_velocity(0.0, 0.0, 0.0), lambda h: h.move_body(0.0)])
def test_a_command_to_stand_still_does_not_end_the_rest(command):
    humanoid = standing()
    simulate(humanoid, SETTLED)
    command(humanoid)
    assert rests(humanoid)


def test_it_rests_again_after_a_walk():
    humanoid = standing()
    simulate(humanoid, SETTLED)
    humanoid.walk_velocity(0.2, 0.0, 0.3)
    simulate(humanoid, 3.0)
    humanoid.stop()
    simulate(humanoid, 8.0)
    assert humanoid.steps > 2
    assert rests(humanoid)
    assert math.isfinite(humanoid.battery.current)


def test_a_resting_robot_with_an_empty_battery_collapses():
    humanoid = standing()
    simulate(humanoid, SETTLED)
    humanoid.battery.set_percentage(1e-5)
    simulate(humanoid, 5.0)
    assert not humanoid.motors_enabled
    assert not rests(humanoid)
