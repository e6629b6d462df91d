"""What the feedback of a rise told, beside what the robot did."""

from __future__ import annotations

import math
from itertools import groupby, pairwise

from autograder.authoring import events as ev
from autograder.authoring.failure import expect
from autograder.authoring.feedback import require_feedback
from autograder.authoring.goal import Goal

from .rising import GAIN, RISEN, STANCE, climb, require_crouch, require_risen

SHIFTING, RISING, SETTLING = PHASES = ("shifting", "rising", "settling")
TOLD = 0.6  # s for a change of the robot to show in the feedback
CLIMBS = 0.03  # m/s
AGE, PERCENT_SLACK, COMPLETE = 0.6, 15.0, 99.5  # s that a report may be old; percent


def told(goal: Goal, begin: float = -math.inf, end: float = math.inf) -> list[ev.FeedbackReceived]:
    """Return the feedback between two moments (s) and before the result; of the whole goal there must be some."""
    require_feedback(goal)
    end = min(end, goal.result.t) if goal.result else end
    return [feedback for feedback in goal.feedback if begin <= feedback.t <= end]


def require_named_phases(goal: Goal) -> None:
    """Require that an undisturbed rise is told as shifting, rising, settling, each where the robot does it."""
    require_risen(goal)
    phases = told(goal)
    for feedback in phases:
        _require_known_phase(feedback)
    seen = [phase for phase, _ in groupby(feedback.feedback.phase for feedback in phases)]
    expect(
        seen in (list(PHASES), list(PHASES[1:])),
        expected="the phases shifting, rising, settling in the feedback, in this order",
        observed=", ".join(seen),
        help="Keep the phase in a variable, change it where a measurement ends it, and copy it to feedback.phase.",
        at=phases[0].t,
    )
    for feedback in phases:
        recent = goal.run.robot_between(feedback.t - TOLD / 2, feedback.t)
        heights = [robot.z for robot in recent]
        phase = feedback.feedback.phase
        rises = min(climb(goal.run, robot.t) for robot in recent) > 2 * CLIMBS and max(heights) < RISEN - GAIN
        expect(
            phase == RISING or not rises,
            expected="the phase rising while the pelvis comes up",
            observed=f"{phase!r} at {heights[-1]:.3f} m",
            help="Enter rising where you begin to publish linear.z, and settling where odom says 0.59 m.",
            at=feedback.t,
        )
        expect(
            phase != SETTLING or max(heights) >= RISEN - GAIN,
            expected=f"the phase settling from {RISEN} m on",
            observed=f"it settles at {heights[-1]:.3f} m",
            help="Enter settling when odom's height is 0.59 m, not after a time.",
            at=feedback.t,
        )


def _require_known_phase(feedback: ev.FeedbackReceived) -> None:
    expect(
        feedback.feedback.phase in PHASES,
        expected="feedback.phase to be shifting, rising or settling",
        observed=f"{feedback.feedback.phase!r}",
        help="Use the task's words, letter by letter.",
        at=feedback.t,
    )


def require_measured_percent(goal: Goal) -> None:
    """Require that percent_complete is the share of the height, and 100 when the goal has succeeded."""
    begin, _ = require_crouch(goal), require_risen(goal)
    start = goal.run.robot_at(begin).z
    for feedback in told(goal):
        percent = float(feedback.feedback.percent_complete)
        expect(
            0.0 <= percent <= 100.01,
            expected="percent_complete from 0 to 100",
            observed=f"{percent:g}",
            help="100 * (height - height at acceptance) / (0.60 - height at acceptance), limited to 0 and 100.",
            at=feedback.t,
        )
        recent = goal.run.robot_between(max(begin, feedback.t - AGE), feedback.t)
        true = [max(0.0, 100 * (robot.z - start) / (STANCE - start)) for robot in recent]
        expect(
            min(true) - PERCENT_SLACK <= percent <= max(true) + PERCENT_SLACK,
            expected=f"percent_complete near {true[-1]:.0f}, the share of the height that the pelvis has gained",
            observed=f"{percent:.0f}",
            help="Measure it: 100 * (height - height at acceptance) / (0.60 - height at acceptance).",
            at=feedback.t,
        )
    require_complete(goal)


def require_complete(goal: Goal) -> None:
    """Require that the last feedback says 100 percent."""
    last = told(goal)[-1]
    expect(
        last.feedback.percent_complete >= COMPLETE,
        expected="100 percent in the last feedback of a goal that SUCCEEDED",
        observed=f"{last.feedback.percent_complete:.1f}",
        help="Publish one more feedback with percent_complete 100 before succeed().",
        at=last.t,
    )


def require_percent_never_falls(goal: Goal) -> None:
    """Require that percent_complete never falls, except where the robot has to shift its weight again."""
    feedback = told(goal)
    for before, after in pairwise(feedback):
        was, now = before.feedback.percent_complete, after.feedback.percent_complete
        expect(
            now >= was - 0.01 or after.feedback.phase == SHIFTING,
            expected="percent_complete never to fall, except back in shifting",
            observed=f"{now:.1f} after {was:.1f}, in {after.feedback.phase}",
            help="The pelvis bobs by some millimetres: publish the largest value so far, and begin anew only where you "
            "enter shifting.",
            at=after.t,
        )
