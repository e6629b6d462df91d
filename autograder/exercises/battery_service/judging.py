"""How an answer of the battery service is compared with what the robot published."""

from __future__ import annotations

import math

from autograder import events as ev
from autograder.checks import Failure, expect
from autograder.exercises.common_checks import last_messages, require_answer
from autograder.transcript import CallHistory, Transcript

ROUNDING = 1e-5  # BatteryState holds float32


def answer_of(run: Transcript, index: int) -> CallHistory:
    """Return the call at `index`, which must have been answered."""
    call = run.calls[index]
    require_answer(run, call)
    return call


def require_last_message(run: Transcript, call: CallHistory) -> None:
    """The answer holds the last battery_state there was when the request came."""
    assert call.answer is not None
    response, battery = call.answer.response, call.answer.response["battery"]
    expect(
        response["available"] is True,
        expected="available: true, since the robot had published its battery",
        observed=f"available: {str(response['available']).lower()}, message: {response['message']!r}",
        help="Subscribe to battery_state (relative name) and keep the last message; set available when there "
        "is one.",
        at=call.answer.t,
    )
    recent = last_messages(run, ev.BatteryPublished, call)
    if any(_same(battery, message) for message in recent):
        return
    raise Failure(
        expected=f"the last battery_state: {_describe(recent[-1].model_dump())}",
        observed=_describe(battery),
        help=_advice(battery, recent[-1], run, call),
        at=call.answer.t,
    )


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
