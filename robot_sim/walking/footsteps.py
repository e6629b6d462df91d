"""Footstep planning: from a walking command to a short sequence of footsteps."""

from __future__ import annotations

import math
from typing import NamedTuple

from robot_sim.model.side import Side
from robot_sim.walking.gait_parameters import GaitParameters, StepLimits
from robot_sim.walking.planar import clamp
from ros_runtime.angles import wrap


class Footstep(NamedTuple):
    """The pose of a sole's centre on the floor (m, m, rad), odom frame."""

    x: float
    y: float
    yaw: float


class Goal(NamedTuple):
    """A command to walk until the midpoint of the feet has this pose (m, m, rad), odom frame."""

    x: float
    y: float
    yaw: float


class Velocity(NamedTuple):
    """A command to walk at this velocity (m/s, m/s, rad/s) in the frame of the body."""

    vx: float
    vy: float
    wz: float


Command = Goal | Velocity | None  # None: stand


def plan_footsteps(
    command: Command, stance: Footstep, stance_side: Side, gait: GaitParameters, limits: StepLimits
) -> list[Footstep]:
    """Return the next `gait.planned_steps` footsteps, the first one by the foot that is not `stance_side`.

    The centre of the body (half the feet's width inward of the stance foot) is moved as commanded, within the
    limits of a step. The swing foot lands half the width outward of the new centre.
    """
    footsteps = []
    outward = stance_side.other.sign  # the swing foot's
    x, y, yaw = stance
    half = gait.feet_width / 2
    for _ in range(gait.planned_steps):
        cos, sin = math.cos(yaw), math.sin(yaw)
        centre_x, centre_y = x - sin * outward * half, y + cos * outward * half
        if isinstance(command, Goal):
            forward, left, turn = _towards_goal(command, centre_x, centre_y, yaw, gait)
        elif isinstance(command, Velocity):
            forward, left, turn = _at_velocity(command, outward, gait, limits)
        else:
            forward = left = turn = 0.0
        forward = clamp(forward, -limits.backward, limits.forward)
        left = outward * clamp(left * outward, -limits.inward, limits.outward)
        turn = outward * clamp(turn * outward, -limits.turn_inward, limits.turn_outward)
        centre_x += cos * forward - sin * left
        centre_y += sin * forward + cos * left
        yaw += turn
        x, y = centre_x - math.sin(yaw) * outward * half, centre_y + math.cos(yaw) * outward * half
        footsteps.append(Footstep(x, y, yaw))
        outward = -outward
    return footsteps


def _towards_goal(
    goal: Goal, x: float, y: float, yaw: float, gait: GaitParameters
) -> tuple[float, float, float]:
    """Return the displacement (forward, left, turn) of the body's centre; the robot turns to a far goal first."""
    dx, dy = goal.x - x, goal.y - y
    distance = math.hypot(dx, dy)
    forward = math.cos(yaw) * dx + math.sin(yaw) * dy
    left = math.cos(yaw) * dy - math.sin(yaw) * dx
    if distance <= gait.goal_facing_distance:
        return forward, left, wrap(goal.yaw - yaw)
    turn = wrap(math.atan2(dy, dx) - yaw)
    if abs(turn) > 2.2 and distance < 1.0:
        turn = wrap(turn + math.pi)  # a near goal behind the back is reached walking backwards
    aligned = max(0.0, math.cos(turn)) ** 2
    return aligned * forward, aligned * left, turn


def _at_velocity(
    velocity: Velocity, outward: float, gait: GaitParameters, limits: StepLimits
) -> tuple[float, float, float]:
    """Return the displacement (forward, left, turn) of one step, such that two steps together keep the velocity.

    A foot can move farther outward than inward. So the inward step moves up to its limit, and the outward step
    makes up for the rest.
    """
    left = _share_of_pair(velocity.vy * gait.duration, outward, limits.inward)
    turn = _share_of_pair(velocity.wz * gait.duration, outward, limits.turn_inward)
    return velocity.vx * gait.duration, left, turn


def _share_of_pair(mean: float, outward: float, inward_limit: float) -> float:
    inward = clamp(mean, -inward_limit, inward_limit)
    return 2 * mean - inward if mean * outward > 0 else inward
