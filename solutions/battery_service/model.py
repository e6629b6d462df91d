"""What must hold of every answer of the battery service, clause by clause, in every scenario."""

from __future__ import annotations

import math
from typing import Any

from autograder.authoring import (
    BATTERY,
    Call,
    answered_within,
    answers_from_memory,
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
LOOKED_AT = ("percentage", "voltage", "current")  # fields that people look at first
MOST_SHOWN = 6  # fields
NUMBERS = ("percentage", "voltage", "current", "temperature", "charge", "capacity", "design_capacity")
WHOLE = "copy the whole message, response.battery = message."


def _knowledge(call: Call) -> str:
    return "before the first message" if known_messages(call, BATTERY) == [] else "after the first message"


answers_in_time = answered_within(2.0, SERVICE, clause=4)
never_waits = answers_from_memory(SERVICE, _knowledge, clause=4)


@obligation(1, 3, of=calls(SERVICE), see="02_services#battery-rules")
def repeats_the_last_message(call: Call) -> str | None:
    """`available` is true, and `battery` is the last battery_state that has arrived, every field as it came"""
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
            f"The last message came {silence:.1f} s ago, and that is no reason to forget it: answer with it."
            if silence > 1.0
            else "Your node gets battery_state: keep the last message, and look at each request whether there is one."
        ),
        see=lesson_on_subscribing(call.run, "battery_state"),
    )
    last = known[-1].message
    differing = min((differing_fields(call.response.battery, each.message) for each in known), key=len)
    looked_at = dict.fromkeys([*LOOKED_AT, *(name.split(".")[0] for name in differing)])
    compared = list(looked_at)[:MOST_SHOWN]
    call.require(
        not differing,
        expected=f"the last battery_state: {shown_fields(last, *compared)}",
        observed=shown_fields(call.response.battery, *compared),
        help=_advice(call, last, differing),
    )
    if math.isnan(last.percentage):
        return "a charge that is not measured"
    return "silence of 10 s or more" if silence >= 10.0 else "silence" if silence > 1.0 else "fresh message"


@obligation(2, of=calls(SERVICE))
def says_when_it_knows_nothing(call: Call) -> str | None:
    """Before the first battery_state `available` is false and every number in `battery` is NaN"""
    if known_messages(call, BATTERY) != []:
        return None
    call.expect(
        "available",
        False,
        because="the robot has not published its battery yet",
        help="Start with no message (None) and answer available: false as long as none has arrived.",
    )
    for name in NUMBERS:
        call.expect(
            f"battery.{name}",
            math.nan,
            because="that is ROS's sign for 'not measured', and a client would take any number for a measured one",
            help="A new BatteryState holds 0.0 everywhere: set each number that is not measured to float('nan').",
        )
    return "before the first message"


def _advice(call: Call, last: Any, differing: list[str]) -> str:
    battery = call.response.battery
    earlier = [each.message for each in call.run.all(ev.BatteryPublished) if each.t < call.sent.t]
    if math.isnan(battery.percentage):
        return f"available is true, but the numbers are those for 'nothing known': {WHOLE}"
    if math.isclose(battery.percentage, 100 * last.percentage, rel_tol=0.01):
        return "BatteryState.percentage runs from 0 to 1, not from 0 to 100: pass it on as it came."
    if any(not differing_fields(battery, message) for message in earlier):
        return "This is an older message. Replace the one you keep each time battery_state arrives."
    if not set(LOOKED_AT) & set(differing):
        return f"Other fields are not as they came ({', '.join(differing[:4])}): {WHOLE}"
    if math.isclose(battery.percentage, last.percentage, abs_tol=0.01):
        return f"Pass each field on as it came, without rounding: {WHOLE}"
    return "Do not compute or invent values: answer with the whole message that arrived last."
