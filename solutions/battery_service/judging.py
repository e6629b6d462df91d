"""How an answer of the battery service is compared with what the robot published."""

from __future__ import annotations

import math

from autograder.authoring import events as ev
from autograder.authoring.checks import Failure, expect
from autograder.authoring.missing import unseen
from autograder.authoring.server_checks import last_messages, require_answer
from autograder.authoring.transcript import CallHistory, Transcript

SERVICE = "get_battery_status"
ROUNDING = 1e-5  # BatteryState holds float32
DRAINED = 0.01  # of the charge, while a scenario lasts
SILENCE = 2.0  # s without a message after which a last message is old


def require_first_answer(run: Transcript) -> ev.ServiceAnswered:
    """Return the answer to the first question, asked while the sensor had published nothing at all."""
    answer = require_answer(run, run.call(SERVICE, 1))
    if any(message.t <= answer.t for message in run.all(ev.BatteryPublished)):
        raise unseen(run, "the battery sensor was plugged in too early")
    return answer


def require_last_message(run: Transcript, number: int = 1, *, since: float | None = None) -> None:
    """The first (`number` 1), second, … answer holds the last battery_state there was when the request came.

    A message must have been published after `since` (s; None: after the first that the node heard, which it may keep),
    and have had the time to arrive.
    """
    call = run.call(SERVICE, number)
    answer = require_answer(run, call)
    response, battery = answer.response, answer.response["battery"]
    recent = last_messages(
        run, ev.BatteryPublished, call, since=_first_message(run) if since is None else since
    )
    expect(
        response["available"] is True,
        expected="available: true, since the robot had published its battery",
        observed=f"available: {str(response['available']).lower()}, message: {response['message']!r}",
        help="Subscribe to battery_state (relative name) and keep the last message; set available when there "
        "is one.",
        at=answer.t,
    )
    if any(_same(battery, message) for message in recent):
        return
    raise Failure(
        expected=f"the last battery_state: {_describe(recent[-1].model_dump())}",
        observed=_describe(battery),
        help=_advice(battery, recent[-1], run, call),
        at=answer.t,
    )


def require_last_message_at_each_level(run: Transcript) -> None:
    """Each answer holds the last battery_state, after the battery was set to each of the scenario's levels (0..1)."""
    for number, level in enumerate(run.params["levels"], start=1):
        call = run.call(SERVICE, number)
        told = run.told("set_battery", before=call.sent.t, percentage=level)
        if not any(
            message.t > told.t and abs(message.percentage - level) < DRAINED
            for message in run.all(ev.BatteryPublished)
        ):
            raise unseen(run, f"the battery was never published with {level:.0%}")
        require_last_message(run, number, since=told.t)


def require_last_message_after_silence(run: Transcript) -> None:
    """The answer holds the last message of a sensor that has been silent for a while."""
    call = run.call(SERVICE, 1)
    stopped = run.told("battery_sensor", before=call.sent.t - SILENCE, connected=False)
    if any(stopped.t < message.t <= call.sent.t for message in run.all(ev.BatteryPublished)):
        raise unseen(run, "the battery sensor went on though it was unplugged")
    require_last_message(run)


def require_last_message_after_plugging_in(run: Transcript) -> None:
    """The second answer holds the first messages of a sensor that was plugged in after the first."""
    call = run.call(SERVICE, 2)
    plugged_in = run.told("battery_sensor", before=call.sent.t, connected=True)
    require_last_message(run, 2, since=plugged_in.t)


def _first_message(run: Transcript) -> float:
    """When (s) the first message was published that the node must have heard."""
    ready = run.first(ev.NodeReady)
    published = [message.t for message in run.all(ev.BatteryPublished) if ready and message.t > ready.t]
    return min(published, default=0.0)


def _same(battery: dict, message: ev.BatteryPublished) -> bool:
    return all(
        math.isclose(battery[name], getattr(message, name), rel_tol=ROUNDING, abs_tol=ROUNDING)
        for name in ("percentage", "voltage", "current")
    )


def _describe(battery: dict) -> str:
    return "percentage {percentage:.4f}, voltage {voltage:.2f} V, current {current:.2f} A".format(**battery)


def _advice(battery: dict, last: ev.BatteryPublished, run: Transcript, call: CallHistory) -> str:
    if math.isclose(battery["percentage"], 100 * last.percentage, rel_tol=0.01):
        return "BatteryState.percentage runs from 0 to 1, not from 0 to 100: pass it on as it came."
    if any(_same(battery, old) for old in run.all(ev.BatteryPublished) if old.t < call.sent.t):
        return (
            "This is an older message. Replace the one you keep each time battery_state arrives, not only the "
            "first time."
        )
    if math.isclose(battery["percentage"], last.percentage, abs_tol=ROUNDING):
        return (
            "The percentage is right but other fields are not: copy the whole message, response.battery = "
            "message."
        )
    return (
        "Do not compute or invent values: answer with the whole message that arrived last on battery_state."
    )
