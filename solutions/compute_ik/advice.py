"""Recognises common mistakes: the answer would be right if read with the mistake in mind."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from autograder.authoring import shown

from .reply import side_in_words
from .two_link_arm import TOLERANCE, Point, TwoLinkArm

SAME = 1e-3  # rad
NEARLY = 0.01  # m; rounding to two digits moves the hand no farther
Reading = Callable[[float, float], tuple[float, float]]
_BETWEEN = "The elbow's angle is 0 where the arm is straight; this is the angle between the links:"
# How to read the angles of shoulder and elbow so that a common mistake becomes right, and what to do about it.
_MISREADINGS: list[tuple[Reading, str]] = [
    (lambda s, e: (math.radians(s), math.radians(e)), "These are degrees: leave out math.degrees()."),
    (lambda s, e: (s, e - s), "The elbow's angle is counted from the upper arm: subtract the shoulder's."),
    (lambda s, e: (s, math.pi - e), f"{_BETWEEN} turn the sign of the cosine."),
    (lambda s, e: (s, e - math.pi), f"{_BETWEEN} take pi from it."),
    (
        lambda s, e: (s, -e),
        "The angles belong to different sides: a positive elbow needs a smaller shoulder.",
    ),
    (lambda s, e: (-s, -e), "These angles count clockwise: positive is counter-clockwise, from x to y."),
    (lambda s, e: (e, s), "shoulder and elbow are exchanged in the response."),
]


def advice_for(
    shoulder: float, elbow: float, target: Point, arm: TwoLinkArm, before: Sequence[TwoLinkArm]
) -> str:
    """Say what to do about angles (rad) that do not bring the hand of `arm` to the target (m); `before`: other arms."""
    if not math.isfinite(shoulder + elbow):
        return "An angle is not a number: find the step that divides by 0 or takes acos of more than 1."
    if shoulder == elbow == 0:
        return "Both angles are 0, as in a new response: set response.shoulder and response.elbow."
    direction = math.atan2(target[1], target[0])
    if abs(math.remainder(shoulder - direction, math.tau)) <= SAME and _is_bent_right(elbow, target, arm):
        equal = f"The shoulder equals the direction to the target, {direction:.4f}"
        return f"{equal}: subtract the angle that the bent elbow adds."
    for reading, advice in _MISREADINGS:
        if arm.misses(*reading(shoulder, elbow), target) <= TOLERANCE:
            return advice
    if arm.misses(shoulder, elbow, target[::-1]) <= TOLERANCE:
        return "That is the target with x and y exchanged: it is math.atan2(y, x), in this order."
    for other in before:
        if other != arm and other.misses(shoulder, elbow, target) <= TOLERANCE:
            lengths = f"{other.upper_arm:.2f} and {other.forearm:.2f} m"
            return f"That is right for {lengths}: read upper_arm_length and forearm_length in the callback."
    are_rounded = all(round(angle, 3) == angle for angle in (shoulder, elbow))
    if are_rounded and arm.misses(shoulder, elbow, target) <= NEARLY:
        return "The angles are rounded, and 0.01 rad moves the hand by millimetres: leave out round()."
    if _is_bent_right(elbow, target, arm):
        return (
            "The distance is right, the direction is not: take atan2(y, x), which knows all four quadrants."
        )
    return "Put the angles back in: x = l1 cos(shoulder) + l2 cos(shoulder + elbow), y the same with sin."


def advice_on_the_side(elbow_up: bool, twin_is_above: bool | None) -> str:
    """Say what to do about an elbow on the wrong side, given the side of the answer with the other elbow_up."""
    if twin_is_above is None:
        return "elbow_up decides the sign of the elbow's angle: a positive one has the elbow below the line."
    other, side = f"With elbow_up {shown(not elbow_up)} the elbow was", side_in_words(twin_is_above)
    if twin_is_above == elbow_up:
        return f"{other} {side}: elbow_up is used the wrong way round. Turn the sign of the elbow's angle."
    return f"{other} also {side}: elbow_up is not used. Let it decide the sign of the elbow's angle."


def _is_bent_right(elbow: float, target: Point, arm: TwoLinkArm) -> bool:
    """Return whether the elbow's angle brings the hand as far from the shoulder as the target is."""
    return abs(math.hypot(*arm.hand_at(0.0, elbow)) - math.hypot(*target)) <= TOLERANCE
