"""`ros2 topic`: list, info, type and hz; echo and pub are in topic_echo.py and topic_pub.py."""

from __future__ import annotations

from argparse import Namespace
from collections import deque
from statistics import fmean, pstdev

from rclpy.qos import qos_profile_sensor_data

from ros_cli.command_node import CommandNode, absolute
from ros_cli.errors import unknown
from ros_cli.interface_types import interface_class
from ros_cli.verb import Verbs, add_flag, add_graph_verb, add_list_verb, positive_int
from ros_cli.verbs import topic_echo, topic_pub

WINDOW = 10_000  # messages, of `topic hz`
PRINT_PERIOD = 1_000_000_000  # ns, of `topic hz`
SECOND = 1e9  # ns


def add_verbs(verbs: Verbs) -> None:
    """Add the verbs of this group."""
    topic_echo.add_to(verbs)
    _add_hz(verbs)
    info = add_graph_verb(verbs, "info", print_info, "Print information about a topic")
    info.add_argument("topic_name", help="Name of the ROS topic to get info (e.g. '/chatter')")
    add_flag(info, "-v", "--verbose", help="Print nodes, types, GUIDs and QoS too")
    listing = add_list_verb(
        verbs, "topic", lambda command, options: command.topics(hidden=options.include_hidden_topics)
    )
    add_flag(listing, "-t", "--show-types", help="Additionally show the topic type")
    add_flag(listing, "--include-hidden-topics", help="Consider hidden topics as well")
    topic_pub.add_to(verbs)
    type_of = add_graph_verb(verbs, "type", print_type, "Print a topic's type")
    type_of.add_argument("topic_name", help="Name of the ROS topic to get type (e.g. '/chatter')")


def print_type(options: Namespace) -> None:
    """Print the type of a topic, or all of its types."""
    name = absolute(options.topic_name)
    with CommandNode(options.spin_time) as command:
        command.find(lambda: name in command.topics(), f"the topic {name}")
        print(*_types(command, name), sep="\n")


def print_info(options: Namespace) -> None:
    """Print type, publishers and subscriptions of a topic."""
    name = absolute(options.topic_name)
    end = "\n\n" if options.verbose else "\n"
    with CommandNode(options.spin_time) as command:
        command.discover(lambda: name in command.topics(), f"the topic {name}")
        types = _types(command, name)
        publishers = command.node.get_publishers_info_by_topic(name)
        subscriptions = command.node.get_subscriptions_info_by_topic(name)
    print(f"Type: {types[0] if len(types) == 1 else types}", end=end)
    for kind, endpoints in (("Publisher", publishers), ("Subscription", subscriptions)):
        print(f"{kind} count: {len(endpoints)}", end=end)
        for endpoint in endpoints if options.verbose else ():
            print(endpoint, end=end)


def _types(command: CommandNode, name: str) -> list[str]:
    topics = command.topics()
    if name not in topics:
        raise unknown("topic", name, topics)
    return topics[name]


class ArrivalRate:
    """The rate over the last `window` intervals, as lines to print once a second."""

    def __init__(self, window: int = WINDOW) -> None:
        self._intervals: deque[int] = deque(maxlen=window)
        self._last: int | None = None
        self._printed: int | None = None

    def arrived(self, now: int) -> str | None:
        """Add the time of an arrival (ns); return the lines to print, once a second, else None."""
        if self._last is not None:
            self._intervals.append(now - self._last)
        self._last = now
        if not self._intervals:
            return None
        if self._printed is None:
            self._printed = now
        if now - self._printed < PRINT_PERIOD:
            return None
        self._printed = now
        return self._lines()

    def _lines(self) -> str:
        seconds = [interval / SECOND for interval in self._intervals]
        mean = fmean(seconds)
        return (
            f"average rate: {1 / mean if mean else 0:.3f}\n"
            f"\tmin: {min(seconds):.3f}s max: {max(seconds):.3f}s "
            f"std dev: {pstdev(seconds, mean):.5f}s window: {len(seconds)}"
        )


def _add_hz(verbs: Verbs) -> None:
    hz = add_graph_verb(verbs, "hz", print_rate, "Print the average publishing rate to screen")
    hz.add_argument("topic_name", help="Name of the ROS topic to listen to (e.g. '/chatter')")
    hz.add_argument(
        *("-w", "--window"),
        type=positive_int,
        default=WINDOW,
        help="window size, in # of messages, for calculating rate (default: %(default)s)",
    )


def print_rate(options: Namespace) -> None:
    """Wait for the topic, then print its rate once a second until Ctrl-C."""
    topic = absolute(options.topic_name)
    with CommandNode(options.spin_time) as command:
        if not command.find(lambda: topic in command.topics(), f"the topic {topic}"):
            print(f"WARNING: topic [{topic}] does not appear to be published yet")
            command.wait_until(lambda: topic in command.topics())
        message_type = interface_class(command.topics()[topic][0], "msg")
        arrived = command.messages(message_type, topic, qos_profile_sensor_data)
        rate = ArrivalRate(options.window)
        while True:
            lines = rate.arrived(arrived.get()[0])
            if lines is not None:
                print(lines)
