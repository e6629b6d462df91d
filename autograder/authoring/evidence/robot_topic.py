"""Which message of a robot's topic a server can have received last when it answers a request."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Any

from autograder.authoring.diagnosis.missing import unseen
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.call import Call
from autograder.authoring.evidence.robot_record import RobotRecord

# s on the arena's clock that the delivery of a message may take: 0.2 s of real time at scale 5, 0.1 s at scale 10.
# Scenarios wait a little longer.
DELIVERY = 1.0
PERIOD_SLACK = 0.3  # s by which a period may be longer on a busy machine


@dataclass(frozen=True)
class Sensor:
    """A topic that the robot publishes every `period` s; `kind` is the event that records a message.

    The scenario's command `switch`, with an argument `connected`, stops and resumes it.
    """

    kind: type[ev.Event]
    period: float
    switch: str


BATTERY = Sensor(ev.BatteryPublished, 0.5, "battery_sensor")
JOINTS = Sensor(ev.JointsPublished, 0.05, "joint_sensors")


def known_messages(call: Call, sensor: Sensor) -> list[Any] | None:
    """Return the messages of which any can be the last one received by a server that answered `call`, oldest first.

    The first of them had certainly arrived when the request was sent. The others were published before the answer, and
    may or may not have arrived by then.

    Returns:
        The events; an empty list if certainly none had arrived; None if that is unknown: a message from before the node
        was ready arrives only if both publisher and subscription are transient local.

    Raises:
        CannotBeJudged: the record lacks messages.
    """
    kind = sensor.kind
    ready = call.run.first(ev.NodeReady)
    published = [message for message in call.run.all(kind) if message.t <= call.answered.t]
    arrived = [
        index
        for index, message in enumerate(published)
        if ready and ready.t < message.t <= call.sent.t - DELIVERY
    ]
    if not published:
        return []
    if not arrived:
        return None
    known = published[arrived[-1] :]
    times = [*(message.t for message in known), call.sent.t]
    for earlier, later in pairwise(times):
        if _connected_for(call.run, sensor, earlier, later) > sensor.period + PERIOD_SLACK:
            raise unseen(call.run, f"the robot published nothing from {earlier:.1f} to {later:.1f} s")
    return known


def _connected_for(run: RobotRecord, sensor: Sensor, start: float, end: float) -> float:
    """Return for how long (s) the sensor had been connected at `end`, counted from `start` at the earliest."""
    for event in reversed(run.commands(sensor.switch)):
        if start < event.t < end:
            return end - event.t if event.command["connected"] else 0.0
    return end - start
