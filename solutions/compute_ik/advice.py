"""Recognises common mistakes: undoing the mistake makes the response right."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from autograder.authoring import shown

from .reply import side_in_words
from .two_link_arm import TOLERANCE, Point, TwoLinkArm

SAME = 1e-3  # rad
NEARLY = 0.01  # m; rounding to two digits moves the hand no farther
Correction = Callable[[float, float], tuple[float, float]]
_BETWEEN = "The elbow's angle is 0 when the arm is straight; this is the angle between the links:"
# For each common mistake, a function that undoes it, and the advice for the student.
_CORRECTIONS: list[tuple[Correction, str]] = [
    (lambda s, e: (math.radians(s), math.radians(e)), "These are degrees: leave out math.degrees()."),
    (
        lambda s, e: (s, e - s),
        "The elbow's angle is relative to the upper arm: subtract the shoulder's angle.",
    ),
    (lambda s, e: (s, math.pi - e), f"{_BETWEEN} change the sign of the argument of acos()."),
    (lambda s, e: (s, e - math.pi), f"{_BETWEEN} subtract pi from it."),
    (
        lambda s, e: (s, -e),
        "The two angles belong to different solutions: a positive elbow angle needs the smaller shoulder angle.",
    ),
    (lambda s, e: (-s, -e), "These angles count clockwise: positive is counter-clockwise, from x to y."),
    (lambda s, e: (e, s), "response.shoulder and response.elbow are swapped."),
]


def advice_for(
    shoulder: float, elbow: float, target: Point, arm: TwoLinkArm, before: Sequence[TwoLinkArm]
) -> str:
    """Advise on angles (rad) that do not bring the hand of `arm` to the target (m).

    `before` are arms with lengths that the node had earlier.
    """
    if not math.isfinite(shoulder + elbow):
        return "An angle is NaN or infinite: find the step that divides by 0 or takes acos of more than 1."
    if shoulder == elbow == 0:
        return "Both angles are 0, as in a new response: set response.shoulder and response.elbow."
    direction = math.atan2(target[1], target[0])
    if abs(math.remainder(shoulder - direction, math.tau)) <= SAME and _is_bent_right(elbow, target, arm):
        equal = f"The shoulder equals the direction to the target, {direction:.4f}"
        return f"{equal}: subtract the angle between that direction and the upper arm."
    for correct, advice in _CORRECTIONS:
        if arm.hand_error(*correct(shoulder, elbow), target) <= TOLERANCE:
            return advice
    if arm.hand_error(shoulder, elbow, target[::-1]) <= TOLERANCE:
        return "These angles reach the target with x and y swapped: write math.atan2(y, x), in this order."
    for other in before:
        if other != arm and other.hand_error(shoulder, elbow, target) <= TOLERANCE:
            lengths = f"{other.upper_arm:.2f} and {other.forearm:.2f} m"
            return f"These angles are right for {lengths}: read upper_arm_length and forearm_length in the callback."
    are_rounded = all(round(angle, 3) == angle for angle in (shoulder, elbow))
    if are_rounded and arm.hand_error(shoulder, elbow, target) <= NEARLY:
        return (
            "The angles are rounded, and 0.01 rad moves the hand by several millimetres: leave out round()."
        )
    if _is_bent_right(elbow, target, arm):
        return (
            "The distance is right, the direction is not: use atan2(y, x), which covers all four quadrants."
        )
    return (
        "Check your angles: x = l1 cos(shoulder) + l2 cos(shoulder + elbow) must give the target's x, and the same "
        "with sin its y."
    )


def advice_on_the_side(elbow_up: bool, twin_is_above: bool | None) -> str:
    """Advise on an elbow on the wrong side.

    `twin_is_above` is the elbow's side in the response to the same target with the opposite elbow_up, if known.
    """
    if twin_is_above is None:
        return (
            "elbow_up decides the sign of the elbow's angle: a positive angle puts the elbow below the line."
        )
    other, side = f"With elbow_up {shown(not elbow_up)} the elbow was", side_in_words(twin_is_above)
    if twin_is_above == elbow_up:
        return f"{other} {side}: elbow_up has the opposite effect. Change the sign of the elbow's angle."
    return f"{other} also {side}: elbow_up has no effect. Let it decide the sign of the elbow's angle."


def _is_bent_right(elbow: float, target: Point, arm: TwoLinkArm) -> bool:
    """Return whether the elbow's angle puts the hand at the target's distance from the shoulder."""
    return abs(math.hypot(*arm.hand_at(0.0, elbow)) - math.hypot(*target)) <= TOLERANCE
