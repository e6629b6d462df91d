"""Two hundred random poses for the hands, for each of which it is known whether an arm can reach it."""

from __future__ import annotations

import math
import random
from dataclasses import dataclass

import mujoco
import numpy as np

from robot_sim.arms.arm_chain import ArmChain
from robot_sim.arms.hand import hand_rotation
from robot_sim.arms.inverse_kinematics import HandGoal
from robot_sim.model.build import build_model
from robot_sim.model.posture import take_stance
from robot_sim.model.side import SIDES, Side

SEED = 20614
COUNT = 200
# The reachable poses leave a margin, because the body moves by some centimetres as an arm moves:
SPARE = 0.15  # rad, to the ends of the joints' ranges
STRAIGHT = -0.6  # rad; the elbow is bent more than that
AHEAD = 0.1  # m, of base_link
TOO_FAR = 0.75, 1.2  # m from the waist; the shoulder is 0.17 m from it, the arm 0.52 m long
# m from the waist, with the fingers towards it: so the wrist is 0.54 m from the shoulder at least, and 0.41 m is
# the farthest that it can be.
BACKWARDS = 0.6


@dataclass(frozen=True)
class KnownGoal:
    """A goal in base_link, for a hand of a robot in its stance, and whether the hand can get there."""

    side: Side
    goal: HandGoal
    reachable: bool

    def __str__(self) -> str:
        waist = "waist" if self.goal.with_waist else "arm only"
        orientation = "any" if self.goal.rotation is None else "oriented"
        return f"{self.side.letter}, {waist}, {orientation}, {self.goal.position.round(3).tolist()}"


def known_goals(count: int = COUNT) -> list[KnownGoal]:
    """Return the first `count` of the goals: of each eight, both arms, with and without waist and orientation.

    A fifth of each kind is out of reach.
    """
    chance = random.Random(SEED)
    model = build_model()
    data = mujoco.MjData(model)
    goals = []
    for number in range(count):
        side, with_waist, oriented = SIDES[number % 2], bool(number // 2 % 2), bool(number // 4 % 2)
        reachable = number // 8 % 5 != 4
        draw = _within_reach if reachable else _out_of_reach
        goals.append(KnownGoal(side, draw(chance, model, data, side, with_waist, oriented), reachable))
    return goals


def _within_reach(
    chance: random.Random,
    model: mujoco.MjModel,
    data: mujoco.MjData,
    side: Side,
    with_waist: bool,
    oriented: bool,
) -> HandGoal:
    """Return the hand's pose in a random posture in which the arm does not touch the body."""
    chain = ArmChain(model, side, with_waist)
    while True:
        take_stance(model, data)
        data.qpos[chain.positions] = [
            chance.uniform(low + SPARE, min(high - SPARE, STRAIGHT if name.endswith("elbow") else high))
            for name, low, high in zip(chain.names, chain.low, chain.high, strict=True)
        ]
        mujoco.mj_forward(model, data)
        position = data.site_xpos[chain.grip] - data.body("pelvis").xpos
        if position[0] > AHEAD and not chain.touches_the_robot(data):
            break
    rotation = hand_rotation(data.site_xmat[chain.grip])
    return HandGoal(position, rotation if oriented else None, with_waist)


def _out_of_reach(
    chance: random.Random,
    model: mujoco.MjModel,
    data: mujoco.MjData,
    side: Side,
    with_waist: bool,
    oriented: bool,
) -> HandGoal:
    """Return a position that is too far away, or a near one with an orientation that is impossible there."""
    take_stance(model, data)
    shoulder = data.body(f"{side.letter}_shoulder_pitch_link").xpos - data.body("pelvis").xpos
    centre = np.array([0.0, 0.0, shoulder[2]])  # the axis of the waist, as high as the shoulder
    yaw = chance.uniform(-0.5, 0.5)
    outward = np.array([math.cos(yaw), math.sin(yaw), 0.0])
    if not oriented:
        return HandGoal(centre + chance.uniform(*TOO_FAR) * outward, None, with_waist)
    up = np.array([0.0, 0.0, 1.0])
    rotation = np.column_stack((-outward, np.cross(up, -outward), up))
    return HandGoal(centre + BACKWARDS * outward, rotation, with_waist)
