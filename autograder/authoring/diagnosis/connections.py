"""Explains failures by the topics that a student's node publishes and subscribes to; no verdict depends on them."""

from __future__ import annotations

from autograder.authoring.diagnosis.exit_diagnosis import Remedy
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.record import Record

OUTSIDE = "01_robot_and_graph#names-why"


def _is_subscribed(run: Record, topic: str) -> bool | None:
    """Return whether a subscription matched the robot's `topic`; None if that was not recorded."""
    counts = [
        count
        for peers in run.all(ev.RobotPeers)
        for name, count in peers.subscribers.items()
        if _base(name) == topic
    ]
    return any(counts) if counts else None


def why_no_message_arrives(run: Record, topic: str) -> str | None:
    """Return why the node receives no messages on the robot's `topic`; None if it does, or if the cause is unknown."""
    remedy = _missing_subscription(run, topic)
    return remedy.help if remedy else None


def lesson_on_subscribing(run: Record, topic: str) -> str:
    """Return the lesson on why the node receives no messages on the robot's `topic`; '' (the check's) if it does."""
    remedy = _missing_subscription(run, topic)
    return remedy.see if remedy else ""


def _missing_subscription(run: Record, topic: str) -> Remedy | None:
    topics = run.first(ev.NodeTopics)
    if topics is None or _is_subscribed(run, topic) in (None, True):
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
            f"You subscribe to {topic}, but your subscription does not match the robot's publisher: compare the type, "
            "and request no more than the robot's QoS offers (qos_profile_sensor_data for its sensors).",
            "01_robot_and_graph#qos-fix-intro",
        )
    others = ", ".join(map(_shown, topics.subscribes))
    return Remedy(
        f"Your node does not subscribe to {topic}" + (f", but to {others}." if others else "."),
        "01_robot_and_graph#listen-intro",
    )


def why_no_command_arrives(run: Record, topic: str, *, before: float) -> str | None:
    """Return why no command reached the robot on `topic` `before` a time (s), as a phrase on its publisher."""
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
            "a publisher that appeared after the request: create it in the constructor, because the robot needs a "
            "moment to discover it"
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
        "remove the leading slash, so that the node's namespace is added to the name"
        if name.count("/") == 1
        else "use the relative name alone, without a namespace"
    )
