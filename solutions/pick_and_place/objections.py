"""What speaks against a goal of pick_and_place: what its request holds."""

from __future__ import annotations

import math

from autograder.authoring import Goal
from autograder.authoring.walking.objections import Objection

from .truth import place_of

MOST_FORCE = 25.0  # N


def _is_in_another_frame(goal: Goal) -> str:
    frame = goal.request.place_pose.header.frame_id
    return "" if frame == "odom" else f"place_pose is in frame {frame!r}"


def _is_not_finite(goal: Goal) -> str:
    is_finite = all(map(math.isfinite, place_of(goal)))
    return "" if is_finite else "a coordinate of place_pose is not a finite number"


def _has_senseless_force(goal: Goal) -> str:
    force = goal.request.grasp_force
    return "" if 0.0 < force <= MOST_FORCE else f"no hand can hold with {force:g} N"


FRAME = Objection(
    _is_in_another_frame,
    "Compare goal_request.place_pose.header.frame_id with 'odom' in goal_callback.",
    "rejects_frames",
    "It rejects a place in another frame than odom",
)
NOT_FINITE = Objection(
    _is_not_finite,
    "Test x, y and z with math.isfinite() in goal_callback.",
    "rejects_not_finite",
    "It rejects a place that holds NaN or infinity",
)
FORCE = Objection(
    _has_senseless_force,
    "Write `if not 0.0 < goal_request.grasp_force <= 25.0`: every `<` and `>` with NaN is false.",
    "rejects_forces",
    "It rejects a grasp_force that is NaN, not more than 0 N, or more than 25 N",
)


def is_sound(goal: Goal) -> bool:
    """Return whether nothing that it asks for speaks against it."""
    return not any(objection.because(goal) for objection in (FRAME, NOT_FINITE, FORCE))
