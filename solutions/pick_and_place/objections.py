"""What speaks against a goal of pick_and_place: what its request holds."""

from __future__ import annotations

import math

from autograder.authoring import Goal
from autograder.authoring.walking.objections import objection

from .truth import place_of

MOST_FORCE = 25.0  # N


@objection("Compare goal_request.place_pose.header.frame_id with 'odom' in goal_callback.")
def frames(goal: Goal) -> str:
    """It rejects a place in another frame than odom."""
    frame = goal.request.place_pose.header.frame_id
    return "" if frame == "odom" else f"place_pose is in frame {frame!r}"


@objection("Test x, y and z with math.isfinite() in goal_callback.")
def not_finite(goal: Goal) -> str:
    """It rejects a place that holds NaN or infinity."""
    is_finite = all(map(math.isfinite, place_of(goal)))
    return "" if is_finite else "a coordinate of place_pose is not a finite number"


@objection("Write `if not 0.0 < goal_request.grasp_force <= 25.0`: every `<` and `>` with NaN is false.")
def forces(goal: Goal) -> str:
    """It rejects a grasp_force that is NaN, not more than 0 N, or more than 25 N."""
    force = goal.request.grasp_force
    return "" if 0.0 < force <= MOST_FORCE else f"no hand can hold with {force:g} N"


def is_sound(goal: Goal) -> bool:
    """Return whether nothing that it asks for speaks against it."""
    return not any(each.because(goal) for each in (frames, not_finite, forces))
