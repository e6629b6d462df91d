"""`ros2 node`: list, info."""

from __future__ import annotations

import sys
from argparse import Namespace

from rclpy.action import (
    get_action_client_names_and_types_by_node,
    get_action_server_names_and_types_by_node,
)
from rclpy.node import NodeNameNonExistentError

from ros_cli.command_node import CommandNode, absolute, shown, split_name
from ros_cli.errors import unknown
from ros_cli.verb import Verbs, add_flag, add_graph_verb, add_list_verb


def add_verbs(verbs: Verbs) -> None:
    """Add the verbs of this group."""
    info = add_graph_verb(verbs, "info", print_info, "Output information about a node")
    info.add_argument("node_name", help="Node name to request information")
    add_flag(info, "--include-hidden", help="Display hidden topics, services, and actions as well")
    listing = add_list_verb(verbs, "node", _names)
    add_flag(listing, "-a", "--all", help="Display all nodes even hidden ones")


def print_info(options: Namespace) -> None:
    """Print a node's subscriptions, publishers, services and actions."""
    name = absolute(options.node_name)
    with CommandNode(options.spin_time) as command:
        command.discover(lambda: name in command.node_names(hidden=True), f"the node {name}")
        names = command.node_names(hidden=True)
        if names.count(name) > 1:
            print(
                f'There are {names.count(name)} nodes in the graph with the exact name "{name}". '
                "You are seeing information about only one of them.",
                file=sys.stderr,
            )
        try:
            endpoints = _endpoints(command, name, options.include_hidden)
        except NodeNameNonExistentError:
            raise unknown("node", name, command.node_names()) from None
    print(name)
    for title, names_and_types in endpoints.items():
        print(f"  {title}:")
        print(*[f"    {each}: {', '.join(types)}" for each, types in names_and_types.items()], sep="\n")


def _names(command: CommandNode, options: Namespace) -> list[str]:
    """Return the full names of the nodes; print a warning if two nodes have the same name."""
    names = command.node_names(hidden=options.all)
    if len(set(names)) < len(names) and not options.count:
        print(
            "WARNING: Be aware that there are nodes in the graph that share an exact name, "
            "which can have unintended side effects.",
            file=sys.stderr,
        )
    return names


def _endpoints(command: CommandNode, node: str, hidden: bool) -> dict[str, dict[str, list[str]]]:
    """Return names and types of a node's endpoints, by the titles under which they are printed."""
    name, namespace = split_name(node)
    ours = command.node
    found = {
        "Subscribers": ours.get_subscriber_names_and_types_by_node(name, namespace),
        "Publishers": ours.get_publisher_names_and_types_by_node(name, namespace),
        "Service Servers": ours.get_service_names_and_types_by_node(name, namespace),
        "Service Clients": ours.get_client_names_and_types_by_node(name, namespace),
        "Action Servers": get_action_server_names_and_types_by_node(ours, name, namespace),
        "Action Clients": get_action_client_names_and_types_by_node(ours, name, namespace),
    }
    return {title: shown(names_and_types, hidden) for title, names_and_types in found.items()}
