"""What a student's node is connected to, in a sentence: it explains a failure, and no verdict depends on it."""

from __future__ import annotations

from autograder.authoring.diagnosis.exit_diagnosis import Remedy
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.record import Record

OUTSIDE = "01_robot_and_graph#names-why"


def _hears(run: Record, topic: str) -> bool | None:
    """Return whether the robot was connected to a subscription of its `topic`; None if nothing is known."""
    counts = [
        count
        for peers in run.all(ev.RobotPeers)
        for name, count in peers.subscribers.items()
        if _base(name) == topic
    ]
    return any(counts) if counts else None


def why_nothing_is_heard(run: Record, topic: str) -> str | None:
    """Return why the node gets no message of the robot's `topic`, or None if it does or nothing is known."""
    remedy = _missing_subscription(run, topic)
    return remedy.help if remedy else None


def lesson_on_hearing(run: Record, topic: str) -> str:
    """Return the lesson on why the node gets no message of the robot's `topic`, '' (the check's) if it does."""
    remedy = _missing_subscription(run, topic)
    return remedy.see if remedy else ""


def _missing_subscription(run: Record, topic: str) -> Remedy | None:
    topics = run.first(ev.NodeTopics)
    if topics is None or _hears(run, topic) in (None, True):
        return None
    names = [name for name in topics.subscribes if _base(name) == topic]
    elsewhere = [name for name in names if name not in _robots_names(run)]
    if elsewhere:
        name = elsewhere[0]
        return Remedy(
            f"You subscribe to {_shown(name)}, which the robot does not publish: {_relative(name)}.", OUTSIDE
        )
    if names:
        return Remedy(
            f"You subscribe to {topic}, but the robot's messages do not match: compare the type, and ask for no more "
            "than the robot's QoS offers (qos_profile_sensor_data for its sensors).",
            "01_robot_and_graph#qos-fix-intro",
        )
    others = ", ".join(map(_shown, topics.subscribes))
    return Remedy(
        f"Your node does not subscribe to {topic}" + (f", but to {others}." if others else "."),
        "01_robot_and_graph#listen-intro",
    )


def why_nothing_is_commanded(run: Record, topic: str, *, before: float) -> str | None:
    """Return why no command reaches the robot on `topic` by a time (s): no publisher, elsewhere, or too late."""
    topics = run.all(ev.NodeTopics)
    connected = [
        peers.t
        for peers in run.all(ev.RobotPeers)
        if any(count and _base(name) == topic for name, count in peers.publishers.items())
    ]
    if not topics:
        return None
    if connected:
        if min(connected) <= before:
            return None
        return (
            "a publisher that appeared after the request: make it in the constructor, as the robot needs a moment to "
            "find it"
        )
    published = [name for at in topics for name in at.publishes if _base(name) == topic]
    elsewhere = [name for name in published if name not in _robots_names(run)]
    if elsewhere:
        return f"a publisher on {_shown(elsewhere[0])}: {_relative(elsewhere[0])}"
    if published:
        return "a publisher whose type or QoS does not match: compare the type"
    return "no publisher: create_publisher in the constructor"


def _robots_names(run: Record) -> set[str]:
    return {name for peers in run.all(ev.RobotPeers) for name in (*peers.subscribers, *peers.publishers)}


def _base(name: str) -> str:
    return name.rsplit("/", 1)[-1]


def _shown(name: str) -> str:
    return name[:80] if name.isprintable() else repr(name[:80])


def _relative(name: str) -> str:
    return (
        "remove the slash in front, so that the namespace comes before the name"
        if name.count("/") == 1
        else "give the bare relative name, without a namespace"
    )
