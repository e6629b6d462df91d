"""Compares an answer of the battery service with what the robot published."""

from __future__ import annotations

import math
from typing import Any

from autograder.authoring import events as ev
from autograder.authoring.call import Call
from autograder.authoring.connections import lesson_on_hearing, why_nothing_is_heard
from autograder.authoring.missing import unseen
from autograder.authoring.robot_topic import RobotTopic
from autograder.authoring.transcript import Transcript

BATTERY_STATE = RobotTopic(
    "battery_state",
    ev.BatteryPublished,
    ("percentage", "voltage", "current"),
    "percentage {percentage:.4f}, voltage {voltage:.2f} V, current {current:.2f} A",
)
DRAINED = 0.01  # of the charge, while a scenario lasts
SILENCE = 2.0  # s without a message after which a last message is old


def require_last_message(call: Call, since: float | None = None) -> None:
    """Require that the answer holds the last battery_state at the request, one published after `since` (s)."""
    call.expect(
        "available",
        True,
        because="the robot had published its battery",
        help=why_nothing_is_heard(call.run, "battery_state")
        or "Your node gets battery_state: keep the last message, and look at each request whether there is one.",
        see=lesson_on_hearing(call.run, "battery_state"),
    )
    BATTERY_STATE.require_last_message(call, call.response.battery, since=since, advice=_advice)


def require_at_each_level(run: Transcript) -> None:
    """Require that each answer holds the last battery_state, at each level (0..1) that the scenario set."""
    for level in run.params["levels"]:
        call = run.call(f"at {level:g}")
        told = run.told("set_battery", before=call.sent.t, percentage=level)
        published = [message for message in run.all(ev.BatteryPublished) if message.t > told.t]
        if not any(abs(message.percentage - level) < DRAINED for message in published):
            raise unseen(run, f"the battery was never published with {level:.0%}")
        require_last_message(call, since=told.t)


def require_in_silence(call: Call) -> None:
    """Require that the answer holds the last message of a sensor that has been silent for a while."""
    stopped = call.run.told("battery_sensor", before=call.sent.t - SILENCE, connected=False)
    if any(stopped.t < message.t <= call.sent.t for message in call.run.all(ev.BatteryPublished)):
        raise unseen(call.run, "the battery sensor went on though it was unplugged")
    call.expect(
        "available",
        True,
        because="the last message stays the answer when the robot falls silent",
        help=f"It came {call.sent.t - stopped.t:.1f} s ago, and that is no reason to forget it: answer with it.",
    )
    require_last_message(call)


def _advice(battery: Any, last: Any) -> str | None:
    if math.isnan(battery.percentage):
        return (
            "available is true, but the numbers are those for 'nothing known': assign the kept message, "
            "response.battery = message."
        )
    if math.isclose(battery.percentage, 100 * last.percentage, rel_tol=0.01):
        return "BatteryState.percentage runs from 0 to 1, not from 0 to 100: pass it on as it came."
    if math.isclose(battery.percentage, last.percentage, abs_tol=1e-5):
        return "The percentage is right, other fields are not: copy the whole message, response.battery = message."
    return None
