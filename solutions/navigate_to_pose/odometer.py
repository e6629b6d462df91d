"""distance_traveled, compared with the way of the pelvis without its sway."""

from __future__ import annotations

import math

from autograder.authoring import events as ev
from autograder.authoring.failure import expect
from autograder.authoring.goal import Goal
from autograder.authoring.walking.path import STRIDE, length_walked

LOST = 0.2  # m where the robot turns back: half a leg before it and half a leg after it go uncounted
SHARE, LEAST = 0.15, 0.25  # of the path, or m (more than a step), that distance_traveled may be off
_COUNTS_SWAY = (
    "The pelvis sways 3 cm to each side with every step, also while the robot turns on the spot. Count a leg only when "
    "odom is 0.15 m away from where the last one ended."
)


def require_measured_path(
    goal: Goal, end: ev.ResultReceived, reversals: int = 0, too_much: str = _COUNTS_SWAY
) -> None:
    """Require that the result's distance_traveled is the length of the path, on which it turned back so many times.

    Args:
        goal: which was accepted.
        end: its result.
        reversals: how often the robot turned back on its way.
        too_much: the advice where it tells more than the robot walked.
    """
    walked = length_walked(goal.run, goal.accepted_at, end.t)
    directly = length_walked(goal.run, goal.accepted_at, end.t, STRIDE)
    claimed = float(end.result.distance_traveled)
    straight = math.dist(
        *((r.x, r.y) for r in (goal.run.robot_at(goal.accepted_at), goal.run.robot_at(end.t)))
    )
    if claimed > walked:
        help = too_much
    elif abs(claimed - straight) < LEAST / 2:
        help = (
            "That is the straight distance from start to end: add up the legs of the path, and the way back."
        )
    else:
        help = "Count the path in every round of the loop, from acceptance to the end, also while the robot turns."
    slack = max(SHARE * walked, LEAST)
    least, most = directly - slack - reversals * LOST, walked + slack
    expect(
        least <= claimed <= most,
        expected=f"result.distance_traveled near {walked:.2f} m ({least:.2f} to {most:.2f} m), the path of the pelvis "
        "without its sway",
        observed=f"{claimed:.2f} m",
        help=help,
        at=end.t,
    )
