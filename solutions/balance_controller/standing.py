"""Judges whether the robot is on its feet after a push."""

from __future__ import annotations

from autograder.authoring import events as ev
from autograder.authoring.failure import Failure, expect
from autograder.authoring.transcript import Transcript
from ros_runtime.message_constants import RobotMode

from .gains import NAMES
from .published import in_words
from .sets import TOPIC

AFTERMATH = 3.0  # s after a push in which a robot falls if it does


def require_standing_after_push(run: Transcript) -> None:
    """Require that the robot is on its feet some seconds after the push that the simulator carried out."""
    fallen = [robot for robot in run.ground_truth if robot.mode == RobotMode.FALLEN]
    pushes = [event for event in run.all(ev.RobotCommanded) if event.command.get("do") == "push"]
    if fallen and (not pushes or fallen[0].t < pushes[0].t):
        raise _fell(run, fallen[0].t, "before anybody pushed it")
    pushed = run.told("push").t
    watched = run.robot_between(pushed, pushed + AFTERMATH)
    if fallen:
        raise _fell(run, fallen[0].t, f"{fallen[0].t - pushed:.1f} s after the push")
    expect(
        all(robot.motors_enabled for robot in watched),
        expected="motors that stay on",
        observed="they were switched off",
        help="Publish nothing but balance_gains.",
        at=pushed,
    )


def _fell(run: Transcript, at: float, when: str) -> Failure:
    heard = [event for event in run.heard(TOPIC) if event.t <= at]
    last = (
        in_words({each: getattr(heard[-1].message, each) for each in NAMES}, NAMES)
        if heard
        else "nothing at all"
    )
    off = [event for event in run.all(ev.MotorPowerReceived) if not event.on and event.t <= at]
    return Failure(
        expected="a robot that stays on its feet, because every gain that would let it fall is refused",
        observed=f"it fell {when}, at {at:.1f} s; the last on {TOPIC} before: {last}",
        help="Somebody switched its motors off: publish nothing but balance_gains."
        if off
        else "Compare these gains with the table of the task, and refuse in the on-set callback what is not in it.",
        at=at,
    )
