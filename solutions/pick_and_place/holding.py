"""How the cup is held while it is off the table."""

from __future__ import annotations

import math

from autograder.authoring import SUCCEEDED, Goal, ev, expect, why_rclpy_aborted
from autograder.authoring.walking.life import ended_at, phase

from .life import canceled_at, ends_by_itself, holds_at, is_for_the_cup, is_possible, robbed_at
from .objections import MAX_FORCE
from .truth import carried, reports, taken_from

MIN_LIFT = 0.05  # m
FORCE_TOLERANCE = 0.30  # as a share of grasp_force
MAX_OUTLIERS = 0.02  # as a share of the samples
MIN_SAMPLES = 5
GENTLE, FIRM = 7.0, 12.0  # N


def lifts(goal: Goal) -> str | None:
    """It lifts the cup by at least 5 cm on its way."""
    if not ends_by_itself(goal) or not is_possible(goal):
        return None
    height, until = taken_from(goal)[2], min(ended_at(goal), goal.run.end)
    cups = reports(goal.run, ev.ObjectTruth, goal.accepted_at, until)
    top = max(cup.position[2] for cup in cups) - height
    expect(
        top >= MIN_LIFT,
        expected=f"the cup lifted by at least {MIN_LIFT:.2f} m on its way",
        observed=f"it was at most {top:.3f} m above where it stood",
        help=why_rclpy_aborted(goal)
        or "Close the hand on the cup, move it straight up by 0.12 m, then across, then down.",
        at=until,
    )
    return phase(goal)


def keeps_the_force_asked_for(goal: Goal) -> str | None:
    """While the cup is off the table the measured force is grasp_force, within 30 %."""
    if not is_for_the_cup(goal):
        return None
    until = min(ended_at(goal), robbed_at(goal) or math.inf, goal.run.end)
    held = carried(goal, until)
    if goal.status == SUCCEEDED:
        expect(
            len(held) >= MIN_SAMPLES,
            expected="the cup to be lifted off the table",
            observed="it never left the table",
            help="Close the hand around the cup and lift it.",
            at=until,
        )
    if len(held) < MIN_SAMPLES:
        return None
    wanted = goal.request.grasp_force
    low, high = wanted * (1 - FORCE_TOLERANCE), min(MAX_FORCE, wanted * (1 + FORCE_TOLERANCE))
    outside = [grip for grip in held if not low <= grip.force <= high or grip.strongest > MAX_FORCE]
    worst = max(held, key=lambda grip: abs(grip.force - wanted))
    expect(
        len(outside) <= MAX_OUTLIERS * len(held),
        expected=f"a force from {low:.1f} to {high:.1f} N while the cup is in the air (grasp_force is {wanted:g} N)",
        observed=f"{worst.force:.1f} N",
        help="r_gripper/command is an opening in m, not a force. Each pad presses with 400 N per metre by which the "
        "opening is narrower than the cup. Before you lift, measure force.y on r_gripper/wrench, and correct the "
        "opening by the difference to grasp_force, divided by 400.",
        at=worst.t,
    )
    how = "firm" if wanted > FIRM else "gentle" if wanted < GENTLE else "as usual"
    return how if canceled_at(goal) is None else f"{how}, canceled"


def require_held_when(goal: Goal, t: float) -> None:
    """Require that the hand held the cup off the table at a time (s); otherwise the scenario tests nothing."""
    expect(
        holds_at(goal, t),
        expected=f"the hand to hold the cup off the table {t - goal.accepted_at:.0f} s after the goal was accepted",
        observed="the hand does not hold it off the table",
        help=why_rclpy_aborted(goal) or "Grasp the cup and lift it as soon as the goal executes.",
        at=t,
    )
