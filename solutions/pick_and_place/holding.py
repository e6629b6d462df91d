"""How the cup is held while it is off the table."""

from __future__ import annotations

import math

from autograder.authoring import SUCCEEDED, Goal, ev, expect, why_rclpy_aborted
from autograder.authoring.walking.life import ended_at, phase

from .life import canceled_at, holds_at, is_for_the_cup, robbed_at
from .objections import MOST_FORCE
from .truth import carried, reports, taken_from

HIGH = 0.05  # m
BAND = 0.30  # of the force that was asked for
GLITCHES = 0.02  # of the samples
MIN_SAMPLES = 5  # samples
GENTLE, FIRM = 7.0, 12.0  # N


def lifts(goal: Goal) -> str | None:
    """It lifts the cup on its way, by 5 cm at least."""
    result = goal.result
    if result is None or result.status != SUCCEEDED:
        return None
    height = taken_from(goal)[2]
    cups = reports(goal.run, ev.ObjectTruth, goal.accepted_at, result.t)
    top = max(cup.position[2] for cup in cups) - height
    expect(
        top >= HIGH,
        expected=f"the cup lifted by at least {HIGH:.2f} m on its way",
        observed=f"it was at most {top:.3f} m above where it stood",
        help="Close the hand, move it straight up by 0.12 m, then across, then down.",
        at=result.t,
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
            expected="the cup off the table for a while",
            observed="it never was",
            help="Close the hand around the cup and lift it.",
            at=until,
        )
    if len(held) < MIN_SAMPLES:
        return None
    wanted = goal.request.grasp_force
    low, high = wanted * (1 - BAND), min(MOST_FORCE, wanted * (1 + BAND))
    outside = [grip for grip in held if not low <= grip.force <= high or grip.strongest > MOST_FORCE]
    worst = max(held, key=lambda grip: abs(grip.force - wanted))
    expect(
        len(outside) <= GLITCHES * len(held),
        expected=f"a grasp force from {low:.1f} to {high:.1f} N while the cup is in the air ({wanted:g} N asked for)",
        observed=f"{worst.force:.1f} N",
        help="A command is an opening, not a force. Each pad presses with 400 N for each metre by which the command is "
        "narrower than the object: measure on r_gripper/wrench, and change the opening by what is missing, before you "
        "lift.",
        at=worst.t,
    )
    how = "firm" if wanted > FIRM else "gentle" if wanted < GENTLE else "as usual"
    return how if canceled_at(goal) is None else f"{how}, canceled"


def require_held_when(goal: Goal, t: float) -> None:
    """Require that the cup hung in the hand at a time (s); otherwise the scenario has not tested anything."""
    expect(
        holds_at(goal, t),
        expected="the cup off the table, in the hand, by then",
        observed="it is not",
        help=why_rclpy_aborted(goal) or "Grasp the cup and lift it before anything else is done with it.",
        at=t,
    )
