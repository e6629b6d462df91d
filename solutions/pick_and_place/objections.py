"""Reasons to reject a goal of pick_and_place because of its request."""

from __future__ import annotations

import math

from autograder.authoring import Goal
from autograder.authoring.walking.objections import objection

from .truth import place_of

MAX_FORCE = 25.0  # N


@objection("Compare goal_request.place_pose.header.frame_id with 'odom' in goal_callback.")
def frames(goal: Goal) -> str:
    """It rejects a place_pose in another frame than odom."""
    frame = goal.request.place_pose.header.frame_id
    return "" if frame == "odom" else f"place_pose is in frame {frame!r}"


@objection("Test x, y and z with math.isfinite() in goal_callback.")
def not_finite(goal: Goal) -> str:
    """It rejects a place_pose with a NaN or infinite coordinate."""
    is_finite = all(map(math.isfinite, place_of(goal)))
    return "" if is_finite else "a coordinate of place_pose is not a finite number"


@objection("Write `if not 0.0 < goal_request.grasp_force <= 25.0`: every `<` and `>` with NaN is false.")
def forces(goal: Goal) -> str:
    """It rejects a grasp_force that is NaN, 0 N or less, or more than 25 N."""
    force = goal.request.grasp_force
    return "" if 0.0 < force <= MAX_FORCE else f"the hand cannot hold with {force:g} N"


def is_sound(goal: Goal) -> bool:
    """Return whether none of these reasons applies."""
    return not any(each.because(goal) for each in (frames, not_finite, forces))
