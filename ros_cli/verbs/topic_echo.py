"""`ros2 topic echo`: prints the messages of a topic as YAML."""

from __future__ import annotations

import time
from argparse import Namespace
from queue import Empty
from typing import Any

from rclpy.qos import DurabilityPolicy, QoSPresetProfiles, QoSProfile, ReliabilityPolicy
from rclpy.topic_endpoint_info import TopicEndpointInfo

from ros_cli.command_node import CommandNode, absolute
from ros_cli.errors import CommandError, suggestion
from ros_cli.interface_types import interface_class
from ros_cli.verb import Verbs, add_flag, add_graph_verb, natural_number, positive_float
from ros_cli.yaml_values import message_to_yaml
from ros_runtime.messages import is_message

TRUNCATE_LENGTH = 128
POLICIES = (ReliabilityPolicy, DurabilityPolicy)


def add_to(verbs: Verbs) -> None:
    """Add the verb."""
    echo = add_graph_verb(verbs, "echo", print_messages, "Output messages from a topic")
    echo.add_argument("topic_name", help="Name of the ROS topic to listen to (e.g. '/chatter')")
    echo.add_argument("message_type", nargs="?", help="Type of the ROS message (e.g. 'std_msgs/msg/String')")
    add_flag(echo, "--once", help="Print the first message received and then exit")
    echo.add_argument(
        "--timeout", metavar="N", type=positive_float, help="Set a timeout in seconds for waiting"
    )
    echo.add_argument(
        "--field", help="Echo a selected field of a message; '.' selects sub-fields (pose.pose.position)"
    )
    add_flag(echo, "-f", "--full-length", help="Output all elements of arrays and strings")
    echo.add_argument(
        *("-l", "--truncate-length"),
        type=natural_number,
        default=TRUNCATE_LENGTH,
        help="The length to truncate arrays and strings to (default: %(default)s)",
    )
    for policy in POLICIES:
        echo.add_argument(
            f"--qos-{_kind(policy)}",
            choices=policy.short_keys(),
            metavar="POLICY",
            help=f"Quality of service {_kind(policy)} setting to subscribe with: {', '.join(policy.short_keys())} "
            "(default: one that is compatible with the publishers)",
        )


def print_messages(options: Namespace) -> None:
    """Print each message until Ctrl-C or the timeout; with --once, only the first one."""
    topic = absolute(options.topic_name)
    longest = None if options.full_length else options.truncate_length
    with CommandNode(options.spin_time) as command:
        command.discover(lambda: topic in command.topics(), f"the topic {topic}")
        message_type = _message_type(command, topic, options.message_type)
        select(message_type(), options.field)
        qos = fitting_qos(command.node.get_publishers_info_by_topic(topic))
        for policy in POLICIES:
            if (key := getattr(options, f"qos_{_kind(policy)}")) is not None:
                setattr(qos, _kind(policy), policy.get_from_short_key(key))
        arrived = command.messages(message_type, topic, qos)
        deadline = time.monotonic() + (options.timeout or float("inf"))
        while True:
            left = max(0.0, deadline - time.monotonic()) if options.timeout else None
            try:
                _, message = arrived.get(timeout=left)
            except Empty:
                return
            print(as_text(select(message, options.field), longest), end="---\n")
            if options.once:
                return


def fitting_qos(publishers: list[TopicEndpointInfo]) -> QoSProfile:
    """Return sensor QoS, with reliable or transient local if all publishers offer it; print a line if only some do."""
    qos: QoSProfile = QoSPresetProfiles.get_from_short_key("sensor_data")
    for policy, wanted, otherwise in (
        ("reliability", ReliabilityPolicy.RELIABLE, ReliabilityPolicy.BEST_EFFORT),
        ("durability", DurabilityPolicy.TRANSIENT_LOCAL, DurabilityPolicy.VOLATILE),
    ):
        offered = [getattr(publisher.qos_profile, policy) == wanted for publisher in publishers]
        setattr(qos, policy, wanted if offered and all(offered) else otherwise)
        if any(offered) and not all(offered):
            kind = type(wanted).__name__
            print(
                f"Some, but not all, publishers are offering {kind}.{wanted.name}. Falling back to "
                f"{kind}.{otherwise.name} as it will connect to all publishers"
            )
    return qos


def select(message: Any, path: str | None) -> Any:
    """Return the field at 'pose.pose.position', or the message itself for None."""
    for name in filter(None, (path or "").split(".")):
        if not is_message(message) or name not in message.get_fields_and_field_types():
            fields = message.get_fields_and_field_types() if is_message(message) else ()
            known = f"the fields are {', '.join(fields)}" if fields else "a plain value has no fields"
            raise CommandError(f"Invalid field '{path}': no field {name!r}; {known}")
        message = getattr(message, name)
    return message


def as_text(value: Any, longest: int | None) -> str:
    """Return a message as YAML and another value as Python prints it, with a newline at the end."""
    return message_to_yaml(value, longest=longest) if is_message(value) else f"{value}\n"


def _message_type(command: CommandNode, topic: str, given: str | None) -> Any:
    if given is not None:
        return interface_class(given, "msg")
    types = command.topics().get(topic, [])
    if len(types) > 1:
        raise CommandError(
            f"Cannot echo topic '{topic}', as it contains more than one type: [{', '.join(types)}]; "
            "name one after the topic"
        )
    if not types:
        print(f"WARNING: topic [{topic}] does not appear to be published yet")
        advice = suggestion(topic, command.topics(), "start its node, or name the type after the topic")
        raise CommandError(f"Could not determine the type for the passed topic: {advice}")
    return interface_class(types[0], "msg")


def _kind(policy: Any) -> str:
    """Return "reliability" for ReliabilityPolicy: the name of the setting in a profile."""
    return str(policy.__name__.removeprefix("QoS").removesuffix("Policy").lower())
