"""What a joint query has received before a request, and which names the robot has."""

from __future__ import annotations

import math
from collections.abc import Mapping
from itertools import pairwise

from autograder.authoring import DELIVERY, JOINTS, Call, RobotRecord, ev, known_messages, same
from autograder.authoring.evidence.fields import ROUNDING

SILENCE = 1.0  # s without a message; joint_states is published 20 times a second
MIN_MESSAGES = 2  # between two responses
MAX_INTERVAL = 0.4  # s between two requests, so short that a table renewed twice a second is mostly old

Positions = Mapping[str, float]  # rad (fingers: m), by the joint's name


def must_know(call: Call) -> bool:
    """Return whether a message had certainly arrived before the request."""
    return bool(known_messages(call, JOINTS))


def moved_between(one: Call, other: Call) -> bool:
    """Return whether the same names were requested again soon, after several messages with different positions."""
    names = list(one.request.names)
    if not names or list(other.request.names) != names or other.sent.t - one.sent.t > MAX_INTERVAL:
        return False
    between = [each for each in one.run.all(ev.JointsPublished) if one.answered.t < each.t < other.sent.t]
    places = [tuple(positions_by_name(each)[name] for name in names) for each in between]
    far = all(
        abs(a - b) > ROUNDING
        for before, after in pairwise(places)
        for a, b in zip(before, after, strict=True)
    )
    return len(between) >= MIN_MESSAGES and far


def ought_to_succeed(call: Call) -> bool:
    """Return whether all names are joints, and a message had arrived, or would have with a subscription."""
    return (must_know(call) or is_unsubscribed(call)) and not unknown_names(call)


def is_unsubscribed(call: Call) -> bool:
    """Return whether the robot published no joint_states before the call for lack of a subscription."""
    ready = call.run.first(ev.NodeReady)
    if ready is None or call.run.first(ev.JointsPublished) is not None:
        return False
    switches = [step[0] for step in call.run.params["steps"] if step[0] in ("plug_in", "unplug")]
    since = 0.0 if switches[:1] != ["plug_in"] else math.inf
    for event in call.run.all(ev.RobotCommanded):
        if event.command["do"] == JOINTS.switch and event.t < call.sent.t:
            since = event.t if event.command["connected"] else math.inf
    return max(since, ready.t) < call.sent.t - DELIVERY


def robot_joints(run: RobotRecord) -> list[str]:
    """Return the names of the joints that the robot published."""
    published = run.first(ev.JointsPublished)
    return list(published.names) if published else []


def unknown_names(call: Call) -> list[str]:
    """Return the requested names that no joint has, each once; none if the robot has not published its names."""
    known = robot_joints(call.run) or call.request.names
    return [name for name in dict.fromkeys(call.request.names) if name not in known]


def positions_by_name(message: ev.JointsPublished) -> Positions:
    """Return the positions in a message by the joint's name."""
    return dict(zip(message.names, message.positions, strict=True))


def is_at(name: str, position: float, table: Positions) -> bool:
    """Return whether a joint was at a position."""
    return name in table and same(position, table[name])


def situation(call: Call) -> str:
    """Return, for the table of clauses, the age of the last message, or that its order was different."""
    known = known_messages(call, JOINTS) or []
    silence = call.sent.t - known[-1].t
    if silence > SILENCE:
        return "a pause of 10 s or more" if silence >= 10.0 else "a pause"
    return "another order" if known[-1].names != robot_joints(call.run) else "a recent message"
