"""Whether a robot that somebody leans on waits until its feet carry alike."""

from __future__ import annotations

from collections.abc import Sequence

from autograder.authoring import events as ev
from autograder.authoring.failure import expect
from autograder.authoring.goal import Goal
from autograder.authoring.missing import unseen
from autograder.authoring.robot_record import RobotRecord

from .reports import SHIFTING, TOLD, told
from .rising import GAIN, RISEN, require_begun, require_crouch, require_success

UNEVEN = 0.6  # of the larger load; with less the robot has to shift its weight
LEANED = 1.2  # s that loads have to be uneven
REACTION = 0.6  # s for a server to see that, and for the pelvis to come to rest
STOPPING = 0.08  # m that the pelvis may rise while it stops; at 0.15 m/s it rises 0.025 m after a zero Twist has come
_LOADS = (
    "Subscribe to l_foot/wrench and r_foot/wrench: force.z is what a foot carries. Rise only when the smaller has been "
    "at least 0.8 of the larger for 0.3 s."
)


def feet(run: RobotRecord, begin: float, end: float) -> Sequence[ev.FeetTruth]:
    """Return what the feet carried between two moments (s)."""
    return [sample for sample in run.all(ev.FeetTruth) if begin <= sample.t <= end]


def require_leaned_on(run: RobotRecord) -> tuple[float, float]:
    """Return from when until when (s) the loads were uneven because somebody leaned on the robot."""
    push = run.told("push")
    samples = feet(run, push.t, push.t + push.command.get("duration", 0.0))
    uneven = [sample.t for sample in samples if share(sample) < UNEVEN]
    if not uneven or uneven[-1] - uneven[0] < LEANED or not _mostly(uneven, samples):
        raise unseen(run, "nobody leaned on the robot so that its loads became uneven")
    return uneven[0], uneven[-1]


def share(sample: ev.FeetTruth) -> float:
    """Return the smaller load as a share of the larger."""
    return max(0.0, min(sample.left, sample.right)) / max(sample.left, sample.right, 1.0)


def _mostly(uneven: Sequence[float], samples: Sequence[ev.FeetTruth]) -> bool:
    return len(uneven) > 0.9 * sum(uneven[0] <= sample.t <= uneven[-1] for sample in samples)


def require_waited(goal: Goal) -> None:
    """Require that the robot did not begin to rise while somebody leaned on it, and said that it was shifting."""
    run = goal.run
    accepted = require_crouch(goal)
    require_success(goal)
    _, even = require_leaned_on(run)
    if even < accepted + LEANED:
        raise unseen(run, "nobody leaned on the robot after the goal was accepted")
    start = run.robot_at(accepted).z
    highest = max(run.robot_between(accepted, even), key=lambda robot: robot.z)
    expect(
        highest.z <= start + GAIN,
        expected="the pelvis to stay down while one foot carries much more than the other",
        observed=f"it rose from {start:.2f} to {highest.z:.2f} m, with loads of {_loads(run, highest.t)}",
        help=_LOADS,
        at=highest.t,
    )
    _require_shifting(goal, accepted + TOLD / 2, even)


def require_shifted_again(goal: Goal) -> None:
    """Require that a robot that was leaned on while it rose stopped, shifted its weight, and then rose."""
    run = goal.run
    require_crouch(goal)
    require_success(goal)
    uneven, even = require_leaned_on(run)
    before = run.robot_at(uneven)
    require_begun(goal, run.told("push").t)
    if before.z > RISEN - STOPPING - GAIN:
        raise unseen(run, "the robot had risen before its loads became uneven")
    highest = max(run.robot_between(uneven + REACTION, even), key=lambda robot: robot.z)
    expect(
        highest.z <= before.z + STOPPING,
        expected="the pelvis to stop while one foot carries much more than the other",
        observed=f"it rose from {before.z:.2f} to {highest.z:.2f} m, with loads of {_loads(run, highest.t)}",
        help="Look at the loads also while it rises: when the smaller is below 0.6 of the larger, publish a zero "
        "Twist and go back to shifting.",
        at=highest.t,
    )
    _require_shifting(goal, uneven + TOLD, even)


def _require_shifting(goal: Goal, begin: float, end: float) -> None:
    feedback = told(goal, begin, end)
    if not feedback:
        raise unseen(goal.run, "no feedback came while somebody leaned on the robot")
    for each in feedback:
        expect(
            each.feedback.phase == SHIFTING,
            expected="the phase shifting while the loads are uneven",
            observed=f"{each.feedback.phase!r}, with loads of {_loads(goal.run, each.t)}",
            help="Let the loads choose the phase: shifting ends only after 0.3 s of even loads, and uneven ones lead "
            "back to it.",
            at=each.t,
        )


def _loads(run: RobotRecord, t: float) -> str:
    sample = min(run.all(ev.FeetTruth), key=lambda sample: abs(sample.t - t), default=None)
    return f"{sample.left:.0f} and {sample.right:.0f} N" if sample else "unknown"
