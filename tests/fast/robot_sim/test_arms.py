"""Trajectories of the upper body, reaching, and the hands."""

from __future__ import annotations

import math

import numpy as np
import pytest

from bench.robot.grasping import Grasp
from bench.robot.hands import Grasps
from bench.robot.reach import HandTarget
from bench.robot.trial import simulate
from bench.robot.trial_humanoid import TrialHumanoid
from robot_sim.arms.joint_trajectory import HOLD, JointPath, JointTrajectory, Waypoint
from robot_sim.arms.upper_body import UpperBodyParameters
from robot_sim.model.joint_names import arm_joints
from robot_sim.model.side import Side
from robot_sim.state import Mode

ELBOW = "r_elbow"


@pytest.fixture
def humanoid() -> TrialHumanoid:
    robot = TrialHumanoid()
    simulate(robot, 0.3)
    return robot


def joint(humanoid: TrialHumanoid, name: str) -> tuple[float, float]:
    state = humanoid.joint_state()
    index = state.names.index(name)
    return float(state.position[index]), float(state.velocity[index])


def to(position: float, time: float, velocity: float | None = None, name: str = ELBOW) -> JointTrajectory:
    velocities = () if velocity is None else (velocity,)
    return JointTrajectory((name,), (Waypoint(time, (position,), velocities),))


def test_a_trajectory_is_followed_to_the_milliradian(humanoid):
    ready = (0.7, -0.25, -0.1, -2.0, 0.2, -0.1, 0.05)
    names = tuple(arm_joints(Side.RIGHT))
    humanoid.move_joints(JointTrajectory(names, (Waypoint(1.0, ready, (0.0,) * 7),)))
    simulate(humanoid, 1.5)
    assert [joint(humanoid, name)[0] for name in names] == pytest.approx(ready, abs=2e-3)
    assert humanoid.mode is Mode.STANDING


def test_velocities_at_a_waypoint_are_honoured(humanoid):
    start, _ = joint(humanoid, ELBOW)
    humanoid.move_joints(
        JointTrajectory(
            (ELBOW,), (Waypoint(1.0, (start - 0.5,), (-1.0,)), Waypoint(2.0, (start - 1.0,), (0.0,)))
        )
    )
    simulate(humanoid, 1.0)
    assert joint(humanoid, ELBOW) == pytest.approx((start - 0.5, -1.0), abs=0.03)
    simulate(humanoid, 1.3)
    assert joint(humanoid, ELBOW) == pytest.approx((start - 1.0, 0.0), abs=0.01)


def test_without_velocities_the_path_is_linear(humanoid):
    start, _ = joint(humanoid, ELBOW)
    humanoid.move_joints(to(start - 1.0, 2.0))
    simulate(humanoid, 0.5)
    assert joint(humanoid, ELBOW) == pytest.approx((start - 0.25, -0.5), abs=0.02)


def test_a_new_trajectory_replaces_the_old_on_the_way_without_a_jump(humanoid):
    start, _ = joint(humanoid, ELBOW)
    humanoid.move_joints(to(start - 1.5, 1.5, 0.0))
    simulate(humanoid, 0.75)
    before, speed = joint(humanoid, ELBOW)
    assert speed < -1.0
    humanoid.move_joints(to(start, 1.5, 0.0))
    humanoid.step()
    after, _ = joint(humanoid, ELBOW)
    assert after == pytest.approx(before + speed * humanoid.timestep, abs=2e-3)
    simulate(humanoid, 2.0)
    assert joint(humanoid, ELBOW) == pytest.approx((start, 0.0), abs=5e-3)


def test_an_empty_trajectory_holds(humanoid):
    start, _ = joint(humanoid, ELBOW)
    humanoid.move_joints(to(start - 1.5, 1.5))
    simulate(humanoid, 0.6)
    humanoid.move_joints(HOLD)
    simulate(humanoid, 0.5)
    held, _ = joint(humanoid, ELBOW)
    simulate(humanoid, 1.0)
    assert joint(humanoid, ELBOW) == pytest.approx((held, 0.0), abs=2e-3)
    assert start - 1.0 < held < start - 0.5


def test_joints_that_a_new_trajectory_leaves_out_hold(humanoid):
    humanoid.move_joints(to(-1.0, 1.0, name="r_shoulder_pitch"))
    simulate(humanoid, 0.5)
    humanoid.move_joints(to(-1.5, 1.0))
    simulate(humanoid, 0.3)
    held, _ = joint(humanoid, "r_shoulder_pitch")
    simulate(humanoid, 1.0)
    assert joint(humanoid, "r_shoulder_pitch") == pytest.approx((held, 0.0), abs=5e-3)


def test_positions_stay_within_range_and_speeds_within_the_limit(humanoid):
    fastest = UpperBodyParameters().arm_speed
    humanoid.move_joints(to(-9.0, 0.01))
    speeds = []
    for _ in range(300):
        humanoid.step()
        speeds.append(abs(joint(humanoid, ELBOW)[1]))
    low = humanoid.model.joint(ELBOW).range[0]
    assert joint(humanoid, ELBOW)[0] == pytest.approx(low, abs=0.03)
    assert 0.8 * fastest < max(speeds) < 1.3 * fastest


def test_both_arms_may_swing_while_it_walks(humanoid):
    humanoid.walk_velocity(0.3, 0.0, 0.2)
    for turn in range(4):
        swing = 0.6 if turn % 2 else -0.6
        joints = ("l_shoulder_pitch", "r_shoulder_pitch", "waist_yaw", "head_pan")
        humanoid.move_joints(JointTrajectory(joints, (Waypoint(0.8, (swing, -swing, swing / 2, swing)),)))
        simulate(humanoid, 1.0)
    assert humanoid.mode is Mode.WALKING


@pytest.mark.parametrize(
    ("joints", "waypoints", "message"),
    [
        (("r_knee",), (Waypoint(1.0, (0.5,)),), "belongs to a leg"),
        (("r_finger_1",), (Waypoint(1.0, (0.0,)),), "use the gripper's command"),
        (("r_elbo",), (Waypoint(1.0, (0.0,)),), r"'r_elbo' is not known; the joints are waist_yaw"),
        ((ELBOW, ELBOW), (), "named twice"),
        ((ELBOW,), (Waypoint(1.0, ()),), "0 positions for 1 joints"),
        ((ELBOW,), (Waypoint(1.0, (0.0,), (0.0, 0.0)),), "2 velocities for 1 joints"),
        ((ELBOW,), (Waypoint(1.0, (math.nan,)),), "not finite"),
        ((ELBOW,), (Waypoint(1.0, (0.0,)), Waypoint(1.0, (0.1,))), "waypoint 1 is at 1 s; times must"),
        ((ELBOW,), (Waypoint(-1.0, (0.0,)),), "must not be negative"),
    ],
)
def test_an_invalid_trajectory_is_refused(joints, waypoints, message):
    with pytest.raises(ValueError, match=message):
        JointTrajectory(joints, waypoints)


def test_a_path_through_several_waypoints_is_continuous():
    trajectory = JointTrajectory(
        (ELBOW,), (Waypoint(0.0, (0.1,)), Waypoint(0.5, (0.3,), (0.4,)), Waypoint(1.5, (0.2,), (0.0,)))
    )
    path = JointPath(trajectory, (0.1,), (0.0,))
    positions = [path.at(time)[0] for time in np.arange(0.0, 2.0, 0.01)]
    assert positions[0] == pytest.approx(0.1)
    assert positions[-1] == 0.2
    assert np.abs(np.diff(positions)).max() < 0.02


def test_without_power_arms_hang_and_commands_are_ignored(humanoid):
    humanoid.set_motor_power(False)
    humanoid.move_joints(to(-2.0, 0.1))
    humanoid.open_hand(Side.RIGHT, 0.09)
    humanoid.set_motor_power(True)
    simulate(humanoid, 1.0)
    assert joint(humanoid, ELBOW)[0] > -1.0
    assert humanoid.hands[Side.RIGHT].opening < 0.01


def test_a_hand_reaches_a_point_and_keeps_it(humanoid):
    target = (0.35, -0.2, 0.9)
    reach = humanoid.reach(Side.RIGHT, HandTarget(target, speed=0.5))
    assert simulate(humanoid, 3.0, until=lambda: reach.error() < 0.005)
    humanoid.push((3.0, 0.0, 0.0))
    simulate(humanoid, 2.0)
    grip = humanoid.data.site("r_grip").xpos
    assert grip == pytest.approx(target, abs=0.01)


def test_a_point_out_of_reach_leaves_the_robot_on_its_feet(humanoid):
    reach = humanoid.reach(Side.LEFT, HandTarget((1.5, 0.5, 1.0), with_waist=True))
    simulate(humanoid, 5.0)
    assert reach.error() > 0.5
    assert humanoid.mode is not Mode.FALLEN


def test_a_reach_to_infinity_is_refused(humanoid):
    with pytest.raises(ValueError, match="expected three finite numbers"):
        humanoid.reach(Side.LEFT, HandTarget((0.3, math.inf, 0.9)))


@pytest.mark.parametrize(("asked", "got"), [(0.05, 0.05), (0.2, 0.09), (-1.0, 0.0)])
def test_a_hand_opens_as_far_as_commanded(humanoid, asked, got):
    humanoid.open_hand(Side.LEFT, asked)
    simulate(humanoid, 1.0)
    assert humanoid.hands[Side.LEFT].opening == pytest.approx(got, abs=2e-3)


def test_it_grasps_the_cup_and_puts_it_down():
    run = Grasps().run((0.33, -0.17, 0.33, -0.08))
    assert run.success, run.note
    assert 8.0 < run.values["force_N"] < 12.0
    assert run.values["error_m"] < 0.01


def test_the_force_sensor_filters_a_jerk_but_detects_a_lost_object():
    robot = TrialHumanoid("table")
    simulate(robot, 0.3)
    grasp, hand = Grasp(robot), robot.hands[Side.RIGHT]
    grasp.get_ready()
    assert grasp.approach()
    assert grasp.close()
    grasp.lift()
    hand.open_to(0.042)  # presses with 7 N
    simulate(robot, 0.5)
    pressed, felt = [], []

    def look() -> bool:
        pressed.append(min(hand.forces))
        felt.append(hand.grip_force)
        return False

    shoulder, _ = joint(robot, "r_shoulder_yaw")
    robot.move_joints(to(shoulder - 0.3, 0.1, name="r_shoulder_yaw"))
    simulate(robot, 0.5, until=look)
    assert min(pressed) == 0.0
    assert min(felt) > 3.0
    assert felt[-1] == pytest.approx(pressed[-1], abs=0.1)
    robot.move_object("cup", (0.5, 0.3, 0.755))
    assert simulate(robot, 0.1, until=lambda: hand.grip_force < 1.0)


def test_a_cup_that_is_let_go_falls():
    humanoid = TrialHumanoid("table")
    simulate(humanoid, 0.3)
    start = humanoid.object_poses()["cup"].position
    humanoid.data.joint("cup").qpos[:3] = 0.33, -0.6, 0.9
    simulate(humanoid, 1.5)
    assert start[2] == pytest.approx(0.755, abs=0.005)
    assert humanoid.object_poses()["cup"].position[2] < 0.1


def test_an_empty_scene_has_no_objects(humanoid):
    assert humanoid.object_poses() == {}
