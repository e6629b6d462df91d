"""What must hold for every response of the battery service, clause by clause, in every scenario."""

from __future__ import annotations

import math
from typing import Any

from sensor_msgs.msg import BatteryState

from autograder.authoring import (
    BATTERY,
    Call,
    answered_within,
    answers_without_waiting,
    calls,
    differing_fields,
    ev,
    known_messages,
    lesson_on_subscribing,
    obligation,
    shown_fields,
    why_no_message_arrives,
)

SERVICE = "get_battery_status"
MAIN_FIELDS = ("percentage", "voltage", "current")
MAX_FIELDS_SHOWN = 6
NUMBERS = ("percentage", "voltage", "current", "temperature", "charge", "capacity", "design_capacity")
COPY_ALL = "copy the whole message: response.battery = message."


def _knowledge(call: Call) -> str:
    return "before the first message" if known_messages(call, BATTERY) == [] else "after the first message"


answers_in_time = answered_within(2.0, SERVICE, clause=4)
never_waits = answers_without_waiting(SERVICE, _knowledge, clause=4)


@obligation(1, 3, of=calls(SERVICE), see="02_services#battery-rules")
def repeats_the_last_message(call: Call) -> str | None:
    """The response has available true, and a battery that equals the last battery_state in every field"""
    known = known_messages(call, BATTERY)
    if not known:
        return None
    silence = call.sent.t - known[-1].t
    call.expect(
        "available",
        True,
        because="the robot had published its battery",
        help=why_no_message_arrives(call.run, "battery_state")
        or (
            f"The last message came {silence:.1f} s before the request: respond with it, however old it is."
            if silence > 1.0
            else "Your node receives battery_state: keep the last message, and in each request check whether there is "
            "one."
        ),
        see=lesson_on_subscribing(call.run, "battery_state"),
    )
    last = known[-1].message
    differing = min((differing_fields(call.response.battery, each.message) for each in known), key=len)
    looked_at = dict.fromkeys([*MAIN_FIELDS, *(name.split(".")[0] for name in differing)])
    compared = list(looked_at)[:MAX_FIELDS_SHOWN]
    call.require(
        not differing,
        expected=f"the last battery_state: {shown_fields(last, *compared)}",
        observed=shown_fields(call.response.battery, *compared),
        help=_advice(call, last, differing),
    )
    if math.isnan(last.percentage):
        return "an unmeasured charge"
    return (
        "a pause of 10 s or more" if silence >= 10.0 else "a pause" if silence > 1.0 else "a recent message"
    )


@obligation(2, of=calls(SERVICE))
def says_when_it_knows_nothing(call: Call) -> str | None:
    """Before the first battery_state, available is false and every number in battery is NaN"""
    if known_messages(call, BATTERY) != []:
        return None
    call.expect(
        "available",
        False,
        because="the robot has not published its battery yet",
        help="Initialise the stored message with None, and set available to false while it is None.",
    )
    for name in NUMBERS:
        call.expect(
            f"battery.{name}",
            math.nan,
            because="in ROS NaN means “not measured”, and a client would take any other value for a measurement",
            help="In a new BatteryState every number is 0.0: set each number that is not measured to float('nan').",
        )
    return "before the first message"


def _advice(call: Call, last: Any, differing: list[str]) -> str:
    battery = call.response.battery
    if not differing_fields(battery, BatteryState()):
        return why_no_message_arrives(call.run, "battery_state") or f"battery is still empty: {COPY_ALL}"
    earlier = [each.message for each in call.run.all(ev.BatteryPublished) if each.t < call.sent.t]
    if math.isnan(battery.percentage):
        return f"available is true, but the numbers are NaN as before the first message: {COPY_ALL}"
    if math.isclose(battery.percentage, 100 * last.percentage, rel_tol=0.01):
        return "BatteryState.percentage is from 0 to 1, not from 0 to 100: copy it unchanged."
    if any(not differing_fields(battery, message) for message in earlier):
        return "This is an older message: in the callback of battery_state, replace the stored message every time."
    if "percentage" not in differing:
        return f"Other fields differ from the message ({', '.join(differing[:4])}): {COPY_ALL}"
    if math.isclose(battery.percentage, last.percentage, abs_tol=0.01):
        return f"The percentage was rounded, or the stored message was changed after it had come: {COPY_ALL}"
    return f"Do not compute values of your own: {COPY_ALL}"
