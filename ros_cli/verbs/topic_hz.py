"""`ros2 topic hz`: prints the rate at which messages arrive."""

from __future__ import annotations

from argparse import Namespace
from collections import deque
from statistics import fmean, pstdev

from rclpy.qos import qos_profile_sensor_data

from ros_cli.command_node import CommandNode, absolute
from ros_cli.interface_types import interface_class
from ros_cli.verb import Verbs, add_graph_verb, positive_int

WINDOW = 10_000  # messages
PRINT_PERIOD = 1_000_000_000  # ns
SECOND = 1e9  # ns


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


def add_to(verbs: Verbs) -> None:
    """Add the verb."""
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
        if not command.find(lambda: topic in command.topics()):
            print(f"WARNING: topic [{topic}] does not appear to be published yet")
            command.wait_until(lambda: topic in command.topics())
        message_type = interface_class(command.topics()[topic][0], "msg")
        arrived = command.messages(message_type, topic, qos_profile_sensor_data)
        rate = ArrivalRate(options.window)
        while True:
            lines = rate.arrived(arrived.get()[0])
            if lines is not None:
                print(lines)
