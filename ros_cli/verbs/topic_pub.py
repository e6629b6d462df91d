"""`ros2 topic pub`: publishes a message once or at a rate."""

from __future__ import annotations

import time
from argparse import Namespace
from collections.abc import Iterator
from itertools import count

from rclpy.duration import Duration
from rclpy.publisher import Publisher

from ros_cli.command_node import CommandNode, absolute
from ros_cli.errors import CommandError
from ros_cli.interface_types import interface_class
from ros_cli.verb import Verbs, add_graph_verb, add_values, given_values, natural_number, positive_float
from ros_cli.yaml_values import message_from_yaml

QUEUE = 10  # messages; reliable, volatile
REMINDER_PERIOD = 1.0  # s between two "Waiting for …" lines
LONGEST_DELIVERY = Duration(seconds=2)


def add_to(verbs: Verbs) -> None:
    """Add the verb."""
    pub = add_graph_verb(verbs, "pub", publish, "Publish a message to a topic")
    pub.add_argument("topic_name", help="Name of the ROS topic to publish to (e.g. '/chatter')")
    pub.add_argument("message_type", help="Type of the ROS message (e.g. 'std_msgs/msg/String')")
    add_values(pub, "values", "Values to fill the message with in YAML format (e.g. 'data: Hello World')")
    pub.add_argument(
        *("-r", "--rate"),
        metavar="N",
        type=positive_float,
        default=1.0,
        help="Publishing rate in Hz (default: 1)",
    )
    pub.add_argument(
        *("-p", "--print"),
        metavar="N",
        type=natural_number,
        default=1,
        help="Only print every N-th published message (default: 1)",
    )
    how_often = pub.add_mutually_exclusive_group()
    how_often.add_argument("-1", "--once", action="store_true", help="Publish one message and exit")
    how_often.add_argument(
        "-t", "--times", type=natural_number, default=0, help="Publish this number of times and then exit"
    )
    pub.add_argument(
        *("-w", "--wait-matching-subscriptions"),
        type=natural_number,
        help="Wait until finding the specified number of matching subscriptions "
        "(default: 1 with --once or --times, otherwise 0)",
    )
    pub.add_argument(
        "--max-wait-time-secs",
        metavar="N",
        type=positive_float,
        help="The longest wait for matching subscriptions (default: endless)",
    )


def publish(options: Namespace) -> None:
    """Publish until Ctrl-C, or as often as --once or --times says."""
    message_type = interface_class(options.message_type, "msg")
    values = given_values(options)
    message_from_yaml(message_type, values)  # report wrong values before waiting
    topic = absolute(options.topic_name)
    times = 1 if options.once else options.times
    wanted = options.wait_matching_subscriptions
    wanted = int(times > 0) if wanted is None else wanted
    if not wanted and options.max_wait_time_secs:
        raise CommandError(
            "--max-wait-time-secs option is only effective with --wait-matching-subscriptions, --once or --times"
        )
    with CommandNode(options.spin_time) as command:
        publisher = command.node.create_publisher(message_type, topic, QUEUE)
        wait_for_subscriptions(command, publisher, wanted, options)
        print("publisher: beginning loop")
        for number in ticks(1 / options.rate, times):
            message = message_from_yaml(message_type, values, now=command.now())
            if options.print and number % options.print == 0:
                print(f"publishing #{number}: {message!r}\n")
            publisher.publish(message)
        publisher.wait_for_all_acked(LONGEST_DELIVERY)


def wait_for_subscriptions(
    command: CommandNode, publisher: Publisher, wanted: int, options: Namespace
) -> None:
    """Wait until `wanted` subscriptions match; print a line every second."""
    deadline = time.monotonic() + (options.max_wait_time_secs or float("inf"))
    while publisher.get_subscription_count() < wanted:
        if time.monotonic() >= deadline:
            raise CommandError(
                f"Timed out waiting for subscribers: Expected {wanted} subscribers but only got "
                f"{publisher.get_subscription_count()} subscribers; "
                f"`topic info -v {publisher.topic_name}` lists the subscriptions with their QoS"
            )
        print(f"Waiting for at least {wanted} matching subscription(s)...")
        timeout = min(REMINDER_PERIOD, max(0.0, deadline - time.monotonic()))
        command.wait_until(lambda: publisher.get_subscription_count() >= wanted, timeout)


def ticks(period: float, times: int) -> Iterator[int]:
    """Yield 1, 2, 3, … at a period (s), the first at once; stop after `times` numbers, never if `times` is 0."""
    began = time.monotonic()
    for number in count(1) if times == 0 else range(1, times + 1):
        time.sleep(max(0.0, began + (number - 1) * period - time.monotonic()))
        yield number
