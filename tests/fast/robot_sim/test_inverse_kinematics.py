"""Joint angles for poses of the hands: solutions are correct, and unreachable poses are refused."""

from __future__ import annotations

from dataclasses import replace

import mujoco
import numpy as np
import pytest

from bench.robot.hand_goals import KnownGoal, known_goals
from bench.robot.hands import HandPoses
from bench.robot.trial import simulate
from robot_sim.arms.inverse_kinematics import (
    ArmInverseKinematics,
    ArmPosture,
    HandGoal,
    Unreachable,
    rotation_vector,
)
from robot_sim.arms.joint_trajectory import JointTrajectory, Waypoint
from robot_sim.humanoid import Humanoid
from robot_sim.model.joint_names import arm_joints
from robot_sim.model.side import SIDES, Side

AHEAD = np.array([0.35, -0.2, 0.3])  # m, in base_link: within reach of the right hand
ACROSS = np.array([0.3, 0.3, 0.35])  # within its reach if the waist turns
BACKWARDS = np.diag([-1.0, -1.0, 1.0])  # fingers towards the robot


@pytest.fixture(scope="module")
def humanoid() -> Humanoid:
    """A robot away from the origin, with a heading other than 0."""
    robot = Humanoid()
    robot.reset(1.3, -0.4, 2.0)
    simulate(robot, 0.5)
    return robot


@pytest.fixture(scope="module")
def kinematics(humanoid: Humanoid) -> ArmInverseKinematics:
    return ArmInverseKinematics(humanoid.model)


def posed(posture: ArmPosture, side: Side) -> tuple[np.ndarray, np.ndarray]:
    """Position and rotation in base_link of the hand of another robot in that posture."""
    robot = Humanoid()
    for name, position in zip(posture.names, posture.positions, strict=True):
        robot.data.joint(name).qpos = position
    mujoco.mj_forward(robot.model, robot.data)
    return robot.hands[side].pose.position - robot.base_pose().position, robot.hands[side].rotation


def misses(known: KnownGoal, kinematics: ArmInverseKinematics, humanoid: Humanoid) -> str:
    """The fault of the solution for a goal, or ""."""
    try:
        posture = kinematics.solve(humanoid.data, known.side, known.goal)
    except Unreachable as error:
        return str(error) if known.reachable else ""
    if not known.reachable:
        return "found, though out of reach"
    for name, position in zip(posture.names, posture.positions, strict=True):
        low, high = humanoid.model.joint(name).range
        if not low < position < high:
            return f"{name} at {position}, outside {low} to {high}"
    position, rotation = posed(posture, known.side)
    far = np.linalg.norm(position - known.goal.position)
    wanted = known.goal.rotation
    turned = 0.0 if wanted is None else np.linalg.norm(rotation_vector(rotation, wanted))
    return "" if far < 5e-4 and turned < 2e-3 else f"{far} m and {turned} rad away"


def test_two_hundred_goals_of_both_arms_are_solved_or_refused_as_they_should(kinematics, humanoid):
    goals = known_goals()
    kinds = {(each.side, each.goal.with_waist, each.goal.rotation is None, each.reachable) for each in goals}
    assert (len(goals), len(kinds)) == (200, 16)
    wrong = {index: misses(known, kinematics, humanoid) for index, known in enumerate(goals)}
    assert {index: note for index, note in wrong.items() if note} == {}


@pytest.mark.parametrize(
    "case", known_goals(8), ids=lambda known: f"{known.side.letter}-{known.goal.with_waist}"
)
def test_a_robot_that_takes_the_posture_has_its_hand_there(case):
    outcome = HandPoses().run(case)
    assert outcome.success, outcome.note


def test_the_waist_helps_only_where_it_may(kinematics, humanoid):
    with pytest.raises(Unreachable):
        kinematics.solve(humanoid.data, Side.RIGHT, HandGoal(ACROSS))
    posture = kinematics.solve(humanoid.data, Side.RIGHT, HandGoal(ACROSS, with_waist=True))
    assert posture.names == ("waist_yaw", *arm_joints(Side.RIGHT))
    assert posture.positions[0] > 0.05


def test_a_waist_that_may_not_turn_is_taken_as_it_stands(kinematics):
    turned = Humanoid()
    turned.move_joints(JointTrajectory(("waist_yaw",), (Waypoint(1.0, (0.6,), (0.0,)),)))
    simulate(turned, 2.0)
    goal = HandGoal(ACROSS)
    posture = kinematics.solve(turned.data, Side.RIGHT, goal)
    assert posture.names == tuple(arm_joints(Side.RIGHT))
    waist = ArmPosture(("waist_yaw", *posture.names), (0.6, *posture.positions))
    assert posed(waist, Side.RIGHT)[0] == pytest.approx(ACROSS, abs=2e-3)


def test_the_same_goal_has_the_same_solution_and_moves_nothing(kinematics, humanoid):
    before = humanoid.data.qpos.copy()
    first, second = (kinematics.solve(humanoid.data, Side.RIGHT, HandGoal(AHEAD)) for _ in range(2))
    assert first == second
    assert (humanoid.data.qpos == before).all()


@pytest.mark.parametrize(
    ("position", "rotation", "reason"),
    [
        ((1.5, -0.2, 0.3), None, "the arm is 0.98. m too short"),
        ((0.0, 0.0, 0.3), None, "inside the robot's own body"),
        ((0.4, -0.2, 0.3), BACKWARDS, "the closest posture found leaves the hand 0.* m and .* rad away"),
    ],
)
def test_an_unreachable_goal_is_refused_with_the_reason(kinematics, humanoid, position, rotation, reason):
    with pytest.raises(Unreachable, match=reason):
        kinematics.solve(humanoid.data, Side.RIGHT, HandGoal(np.array(position), rotation))


@pytest.mark.parametrize("side", SIDES)
def test_a_hand_that_points_ahead_has_the_axes_of_base_link(kinematics, side):
    robot = Humanoid()
    goal = HandGoal(AHEAD * (1, -side.sign, 1), np.eye(3))
    posture = kinematics.solve(robot.data, side, goal)
    for name, position in zip(posture.names, posture.positions, strict=True):
        robot.data.joint(name).qpos = position
    mujoco.mj_forward(robot.model, robot.data)
    assert robot.hands[side].pose.quaternion == pytest.approx((0, 0, 0, 1), abs=2e-3)
    pads = [robot.data.body(f"{side.letter}_finger_{number}").xpos for number in (1, 2)]
    palm = robot.data.body(f"{side.letter}_hand").xpos
    assert (robot.hands[side].pose.position - palm)[0] == pytest.approx(0.11, abs=1e-3)
    assert (pads[0] - pads[1])[1] > 0, "finger 1 is on the left"


def test_a_balancing_body_moves_by_centimetres(kinematics):
    robot = Humanoid()
    simulate(robot, 0.5)
    goal = HandGoal(AHEAD)
    rigid = kinematics.solve(robot.data, Side.RIGHT, goal)
    balancing = kinematics.solve(robot.data, Side.RIGHT, replace(goal, balancing=True))
    gap = posed(balancing, Side.RIGHT)[0] - posed(rigid, Side.RIGHT)[0]
    assert 0.005 < gap[0] < 0.03, "the body goes back, so the arm has to reach further"
    assert gap[2] == pytest.approx(0.0, abs=1e-3)
