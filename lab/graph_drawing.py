"""The live ROS graph as a picture: publishers on the left, topics in the middle, subscribers on the right."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

from IPython.display import HTML

from lab.errors import LabError
from lab.graph import Endpoint, Topic, topics_in_graph
from ros_runtime.drawing.svg import svg

NODE_WIDTH, TOPIC_WIDTH, GAP = 180, 420, 80  # px, as all below
ROW_HEIGHT, BOX_HEIGHT = 34, 26
TOP, MARGIN = 64, 12
TOPIC_X = MARGIN + NODE_WIDTH + GAP
SUBSCRIBER_X = TOPIC_X + TOPIC_WIDTH + GAP
WIDTH = SUBSCRIBER_X + NODE_WIDTH + MARGIN
HEADINGS = {MARGIN: "publishes", TOPIC_X: "topic, type", SUBSCRIBER_X: "subscribes"}
RECEIVES, RECEIVES_NOTHING = 'stroke="#333333"', 'stroke="#c0392b" stroke-dasharray="5 4"'


def draw_graph(*names: str, title: str = "The graph now") -> HTML:
    """Draw topics with their publishers and subscribers; where incompatible QoS keeps messages away, the line is red.

    Without names it draws all topics except /rosout and /parameter_events, which every node has.

    Raises LabError when no node has a topic of these names, or any topic at all.
    """
    topics = topics_in_graph(*names)
    if not topics:
        raise LabError("there is nothing to draw: no node has a topic; use lab.start_robot() first")
    rows = {topic.name: TOP + index * ROW_HEIGHT for index, topic in enumerate(topics)}
    left = _places([(end.node, rows[topic.name]) for topic in topics for end in topic.publishers])
    right = _places([(end.node, rows[topic.name]) for topic in topics for end in topic.subscriptions])
    parts = [
        f'<text x="{x + 8}" y="{TOP - 12}" fill="#555555">{words}</text>' for x, words in HEADINGS.items()
    ]
    parts += [
        _line(MARGIN + NODE_WIDTH, left[end.node], TOPIC_X, rows[topic.name])
        for topic in topics
        for end in topic.publishers
    ]
    parts += [
        _line(TOPIC_X + TOPIC_WIDTH, rows[topic.name], SUBSCRIBER_X, right[end.node], _receives(topic, end))
        for topic in topics
        for end in topic.subscriptions
    ]
    parts += [_node_box(MARGIN, y, node) for node, y in left.items()]
    parts += [_topic_box(rows[topic.name], topic) for topic in topics]
    parts += [_node_box(SUBSCRIBER_X, y, node) for node, y in right.items()]
    height = max([*rows.values(), *left.values(), *right.values()]) + ROW_HEIGHT + MARGIN
    return HTML(svg(parts, width=WIDTH, height=height, title=title, words=_in_words(topics)))


def _places(links: Sequence[tuple[str, int]]) -> dict[str, int]:
    """The y of each node, px: at the mean of its topics, and below the previous node."""
    beside: dict[str, list[int]] = {}
    for node, y in links:
        beside.setdefault(node, []).append(y)
    places: dict[str, int] = {}
    lowest = TOP
    for node, ys in sorted(beside.items(), key=lambda item: sum(item[1]) / len(item[1])):
        places[node] = max(lowest, sum(ys) // len(ys))
        lowest = places[node] + ROW_HEIGHT
    return places


def _receives(topic: Topic, subscription: Endpoint) -> bool:
    return len(topic.incompatible_with(subscription)) < max(len(topic.publishers), 1)


def _line(x1: int, y1: int, x2: int, y2: int, receives: bool = True) -> str:
    middle = BOX_HEIGHT // 2
    return (
        f'<line x1="{x1}" y1="{y1 + middle}" x2="{x2}" y2="{y2 + middle}" stroke-width="1.5" '
        f"{RECEIVES if receives else RECEIVES_NOTHING}/>"
    )


def _node_box(x: int, y: int, node: str) -> str:
    return _box(x, y, NODE_WIDTH, 'rx="13" fill="#eef3f9" stroke="#8aa4c0"') + (
        f'<text x="{x + NODE_WIDTH // 2}" y="{y + 17}" text-anchor="middle">{escape(node)}</text>'
    )


def _topic_box(y: int, topic: Topic) -> str:
    return _box(TOPIC_X, y, TOPIC_WIDTH, 'fill="#fdf6e3" stroke="#c9b87a"') + (
        f'<text x="{TOPIC_X + 8}" y="{y + 17}" fill="#1f5fa8" font-weight="bold">{escape(topic.name)}</text>'
        f'<text x="{TOPIC_X + TOPIC_WIDTH - 8}" y="{y + 17}" text-anchor="end" font-size="11" fill="#555555">'
        f"{escape(topic.type)}</text>"
    )


def _box(x: int, y: int, width: int, look: str) -> str:
    return f'<rect x="{x}" y="{y}" width="{width}" height="{BOX_HEIGHT}" {look}/>'


def _in_words(topics: Sequence[Topic]) -> str:
    def sentence(topic: Topic) -> str:
        publishers = ", ".join(end.node for end in topic.publishers) or "nobody"
        subscribers = [
            end.node if _receives(topic, end) else f"{end.node} (which receives nothing)"
            for end in topic.subscriptions
        ]
        return f"{topic.name}: from {publishers} to {', '.join(subscribers) or 'nobody'}."

    return " ".join(sentence(topic) for topic in topics)
