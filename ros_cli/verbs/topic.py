"""`ros2 topic`: list, info and type; echo, hz and pub are in topic_echo.py, topic_hz.py and topic_pub.py."""

from __future__ import annotations

from argparse import Namespace

from ros_cli.command_node import CommandNode, absolute
from ros_cli.errors import unknown
from ros_cli.verb import Verbs, add_flag, add_graph_verb, add_list_verb
from ros_cli.verbs import topic_echo, topic_hz, topic_pub


def add_verbs(verbs: Verbs) -> None:
    """Add the verbs of this group."""
    topic_echo.add_to(verbs)
    topic_hz.add_to(verbs)
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
    """Print the type of a topic, or all of its types.

    Raises:
        CommandError: there is no such topic.
    """
    name = absolute(options.topic_name)
    with CommandNode(options.spin_time) as command:
        command.find(lambda: name in command.topics())
        print(*_types(command, name), sep="\n")


def print_info(options: Namespace) -> None:
    """Print type, publishers and subscriptions of a topic.

    Raises:
        CommandError: there is no such topic.
    """
    name = absolute(options.topic_name)
    end = "\n\n" if options.verbose else "\n"
    with CommandNode(options.spin_time) as command:
        command.discover(lambda: name in command.topics())
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
