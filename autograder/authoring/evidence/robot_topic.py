"""What a server that answers from a topic of the robot can know at a request: its last message there, or none."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Any

from autograder.authoring.diagnosis.missing import unseen
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.call import Call
from autograder.authoring.evidence.robot_record import RobotRecord

# s a message may be on its way: 0.2 s of real time at scale 5, 0.1 s at scale 10. Scenarios wait a little longer.
DELIVERY = 1.0
LATEST = 0.3  # s that a message may come after its period, on a busy machine


@dataclass(frozen=True)
class Sensor:
    """A topic that the robot publishes in a fixed `period` (s), as `kind` records it, unless `switch` has stopped it.

    `switch` is the scenario's command with an argument `connected`.
    """

    kind: type[ev.Event]
    period: float
    switch: str


BATTERY = Sensor(ev.BatteryPublished, 0.5, "battery_sensor")
JOINTS = Sensor(ev.JointsPublished, 0.05, "joint_sensors")


def known_messages(call: Call, sensor: Sensor) -> list[Any] | None:
    """Return what may be the last message at a server that answered `call`, oldest first.

    It begins with the last message that had certainly arrived at the request, and ends with the last one before the
    answer: those in between may have been on their way.

    Returns:
        The events; an empty list if certainly none had arrived; None if nobody can tell: what the robot published
        before the node was ready reaches it only if robot and node latch it.

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
        if _connected_for(call.run, sensor, earlier, later) > sensor.period + LATEST:
            raise unseen(call.run, f"the robot published nothing from {earlier:.1f} to {later:.1f} s")
    return known


def _connected_for(run: RobotRecord, sensor: Sensor, start: float, end: float) -> float:
    """Return for how long (s) the sensor was connected up to `end`, at most since `start`."""
    for event in reversed(run.commands(sensor.switch)):
        if start < event.t < end:
            return end - event.t if event.command["connected"] else 0.0
    return end - start
