"""Judges how the cup was held while it was off the table."""

from __future__ import annotations

from autograder.authoring import events as ev
from autograder.authoring.failure import expect
from autograder.authoring.goal import Goal
from autograder.authoring.goal_endings import why_rclpy_aborted

from .endings import require_succeeded
from .truth import (
    Grip,
    carried,
    reports,
    taken_from,
)

HIGH = 0.05  # m
BAND = 0.30  # of the force that was asked for
MOST_FORCE = 25.0  # N
HOLDING = 1.0  # N
GLITCHES = 0.02  # of the samples


def require_lifted(goal: Goal) -> None:
    """Require that the cup was lifted on its way."""
    result = require_succeeded(goal)
    height = taken_from(goal)[2]
    top = (
        max(cup.position[2] for cup in reports(goal.run, ev.ObjectTruth, goal.accepted_at, result.t)) - height
    )
    expect(
        top >= HIGH,
        expected=f"the cup lifted by at least {HIGH:.2f} m on its way",
        observed=f"it was at most {top:.3f} m above where it stood",
        help="Close the hand, move it straight up by 0.12 m, then across, then down.",
        at=result.t,
    )


def require_force_kept(goal: Goal) -> None:
    """Require that the force was within 30 % of what was asked for while the cup was off the table."""
    result = require_succeeded(goal)
    wanted = goal.request.grasp_force
    low, high = wanted * (1 - BAND), min(MOST_FORCE, wanted * (1 + BAND))
    held = _require_carried(goal, result.t)
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


def _require_carried(goal: Goal, until: float) -> list[Grip]:
    """Return hand and cup while the cup was off the table, which it must have been."""
    held = carried(goal, until)
    expect(
        len(held) >= 5,
        expected="the cup off the table for a while",
        observed="it never was",
        help="Close the hand around the cup and lift it.",
        at=until,
    )
    return held


def require_held_when(goal: Goal, t: float) -> None:
    """Require that the cup hung in the hand at a time (s); otherwise the scenario has not tested anything."""
    held = carried(goal, t)
    expect(
        bool(held) and held[-1].t >= t - 0.3 and held[-1].force >= HOLDING,
        expected="the cup off the table, in the hand, by then",
        observed="it is not",
        help=why_rclpy_aborted(goal) or "Grasp the cup and lift it before anything else is done with it.",
        at=t,
    )
