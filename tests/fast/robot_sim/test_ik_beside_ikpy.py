"""The arms' inverse kinematics, compared with that of another library, ikpy, which does not use MuJoCo.

ikpy brings SciPy and SymPy, so the environment leaves it out: CONTRIBUTING.md says under "Measure" how to add it.
"""

from __future__ import annotations

import random

import numpy as np
import pytest

from bench.robot.hand_goals import known_goals
from bench.robot.trial import simulate
from robot_sim.arms.inverse_kinematics import ArmInverseKinematics, HandGoal, Unreachable
from robot_sim.arms.servos import RANGE_MARGIN
from robot_sim.humanoid import Humanoid
from robot_sim.model.joint_names import WAIST, arm_joints
from robot_sim.model.side import SIDES, Side

pytest.importorskip("ikpy", reason="ikpy is not installed; CONTRIBUTING.md says how to add it")
from ikpy.chain import Chain
from ikpy.link import OriginLink, URDFLink

PLACES = 20  # of each kind; ikpy takes half a second for one
CLOSE = 1e-3  # m


@pytest.fixture(scope="module")
def humanoid() -> Humanoid:
    robot = Humanoid()
    simulate(robot, 0.3)
    return robot


@pytest.fixture(scope="module")
def kinematics(humanoid: Humanoid) -> ArmInverseKinematics:
    return ArmInverseKinematics(humanoid.model)


def chain_of(humanoid: Humanoid, side: Side, with_waist: bool) -> Chain:
    """The chain from base_link to the grip point for ikpy; a waist that may not turn stays at 0."""
    model, links = humanoid.model, [OriginLink()]
    joints = (WAIST[0], *arm_joints(side))
    for name in joints:
        joint = model.joint(name)
        links.append(
            URDFLink(
                name,
                origin_translation=model.body_pos[joint.bodyid[0]],
                origin_orientation=[0, 0, 0],
                rotation=joint.axis,
                bounds=(joint.range[0] + RANGE_MARGIN, joint.range[1] - RANGE_MARGIN),
                use_symbolic_matrix=False,
            )
        )
    grip = model.site(f"{side.letter}_grip")
    links.append(URDFLink("grip", grip.pos, [0, 0, 0], joint_type="fixed", use_symbolic_matrix=False))
    return Chain(links, active_links_mask=[False, with_waist, *[True] * 7, False])


def hand_in(chain: Chain, positions: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Position and rotation of a hand, x along the fingers, computed by ikpy."""
    frame = chain.forward_kinematics(positions)
    x, y, z = frame[:3, :3].T
    return frame[:3, 3], np.column_stack((-z, y, x))


def test_ikpy_computes_the_goal_from_the_solvers_angles(humanoid, kinematics):
    for known in known_goals():
        if not known.reachable:
            continue
        posture = kinematics.solve(humanoid.data, known.side, known.goal)
        waist = () if known.goal.with_waist else (0.0,)
        chain = chain_of(humanoid, known.side, known.goal.with_waist)
        position, rotation = hand_in(chain, np.array([0.0, *waist, *posture.positions, 0.0]))
        assert position == pytest.approx(known.goal.position, abs=CLOSE)
        if known.goal.rotation is not None:
            assert rotation == pytest.approx(known.goal.rotation, abs=5e-3)


@pytest.mark.parametrize("with_waist", [False, True])
def test_goals_that_ikpy_reaches_are_reached(humanoid, kinematics, with_waist):
    chance = random.Random(4)
    by_both, missed = 0, []
    for number in range(PLACES):
        side = SIDES[number % 2]
        chain = chain_of(humanoid, side, with_waist)
        place = np.array([chance.uniform(0.1, 0.5), chance.uniform(-0.1, 0.5), chance.uniform(0.1, 0.7)])
        place[1] *= side.sign
        relaxed = np.array([0, 0, 0.3, 0.7 * side.sign, 0, -1.4, 0, 0, 0, 0])
        found = chain.inverse_kinematics(place, initial_position=relaxed)
        if np.linalg.norm(hand_in(chain, found)[0] - place) > CLOSE:
            continue
        reason = why_not(kinematics, humanoid, side, HandGoal(place, with_waist=with_waist))
        if not reason:
            by_both += 1
        elif "own body" not in reason:  # ikpy does not check for self-collision
            missed.append((side.letter, place.tolist(), reason))
    assert missed == []
    assert by_both > PLACES / 4, "there was something to compare"


def why_not(kinematics: ArmInverseKinematics, humanoid: Humanoid, side: Side, goal: HandGoal) -> str:
    """The reason why a goal is refused; "" if it is accepted."""
    try:
        kinematics.solve(humanoid.data, side, goal)
    except Unreachable as error:
        return str(error)
    return ""
