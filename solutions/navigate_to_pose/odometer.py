"""distance_traveled, compared with the way of the pelvis without its sway."""

from __future__ import annotations

import math

from autograder.authoring import SUCCEEDED, Goal, expect
from autograder.authoring.walking.life import accepted, interrupted, others, phase, went_down
from autograder.authoring.walking.path import STRIDE, length_walked
from ros_runtime.message_constants import GoalStatus, name_of

from .legs import led_astray, operated

LOST = (
    0.2  # m where the robot turns back, or goes on: half a leg before it and half a leg after it go uncounted
)
SHARE, LEAST = 0.15, 0.25  # of the path, or m (more than a step), that distance_traveled may be off
_COUNTS_SWAY = (
    "The pelvis sways 3 cm to each side with every step, also while the robot turns on the spot. Count a leg only when "
    "odom is 0.15 m away from where the last one ended."
)
_ODOM_TELLS = "Count legs of the way in odom: the robot may not obey what you publish on cmd_vel."
_OF_EACH_GOAL = "Begin the sum at 0 in every goal: keep it in execute, not in the node."


def measures_its_path(goal: Goal) -> str | None:
    """distance_traveled is the path of the pelvis without its sway, walked for this goal, however it ends."""
    end = goal.result
    if not accepted(goal) or end is None or interrupted(goal) or went_down(goal):
        return None
    detour = led_astray(goal) is not None
    ends_standing = not detour and (goal.status == SUCCEEDED or operated(goal))
    walked = length_walked(goal.run, goal.accepted_at, end.t)
    directly = length_walked(goal.run, goal.accepted_at, end.t, STRIDE)
    claimed = float(end.result.distance_traveled)
    there, here = goal.run.robot_at(goal.accepted_at), goal.run.robot_at(end.t)
    straight = math.hypot(here.x - there.x, here.y - there.y)
    if claimed > walked:
        help = _ODOM_TELLS if operated(goal) else _OF_EACH_GOAL if others(goal) else _COUNTS_SWAY
    elif abs(claimed - straight) < LEAST / 2:
        help = (
            "That is the straight distance from start to end: add up the legs of the path, and the way back."
        )
    else:
        help = "Count the path in every round of the loop, from acceptance to the end, also while the robot turns."
    slack = max(SHARE * walked, LEAST)
    least, most = directly - slack - (2 if detour else 0 if ends_standing else 1) * LOST, walked + slack
    expect(
        least <= claimed <= most,
        expected=f"result.distance_traveled near {walked:.2f} m ({least:.2f} to {most:.2f} m), the path of the pelvis "
        "without its sway",
        observed=f"{claimed:.2f} m",
        help=help,
        at=end.t,
    )
    return f"{name_of(GoalStatus, end.status)}, {phase(goal)}"
