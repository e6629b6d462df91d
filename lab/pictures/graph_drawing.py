"""Draws the live ROS graph: publishers on the left, topics in the middle, subscribers on the right."""

from __future__ import annotations

from collections.abc import Sequence

from IPython.display import HTML

from lab.client.graph import Endpoint, Topic, topics_in_graph
from lab.errors import LabError
from ros_runtime.drawing.columns import End, Row, columns_svg

HEADINGS = ("publishes", "topic, type", "subscribes")


def draw_graph(*names: str, title: str = "The graph now") -> HTML:
    """Draw topics with their publishers and subscribers; a subscription with an incompatible QoS has a red line.

    Without names it draws all topics except /rosout and /parameter_events, which every node has.

    Raises LabError when a topic has no publisher and no subscription, or when there are no topics at all.
    """
    topics = topics_in_graph(*names)
    if not topics:
        raise LabError(
            "there is no topic to draw: no node publishes or subscribes to one; use lab.start_robot() first"
        )
    rows = [
        Row(
            topic.name,
            topic.type,
            left=[End(end.node) for end in topic.publishers],
            right=[End(end.node, broken=not _receives(topic, end)) for end in topic.subscriptions],
        )
        for topic in topics
    ]
    return HTML(
        columns_svg(
            rows, headings=HEADINGS, title=title, words=_in_words(topics), broken_means="receives no messages"
        )
    )


def _receives(topic: Topic, subscription: Endpoint) -> bool:
    return len(topic.incompatible_with(subscription)) < max(len(topic.publishers), 1)


def _in_words(topics: Sequence[Topic]) -> str:
    def sentence(topic: Topic) -> str:
        publishers = ", ".join(end.node for end in topic.publishers) or "nobody"
        subscribers = [
            end.node if _receives(topic, end) else f"{end.node} (which receives nothing)"
            for end in topic.subscriptions
        ]
        return f"{topic.name}: from {publishers} to {', '.join(subscribers) or 'nobody'}."

    return " ".join(sentence(topic) for topic in topics)
