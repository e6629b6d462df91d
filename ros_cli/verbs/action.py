"""`ros2 action`: list and info; send_goal is in action_send_goal.py."""

from __future__ import annotations

from argparse import Namespace
from functools import partial

from rclpy.action import (
    get_action_client_names_and_types_by_node,
    get_action_names_and_types,
    get_action_server_names_and_types_by_node,
)

from ros_cli.command_node import CommandNode, absolute
from ros_cli.servers import nodes_with
from ros_cli.verb import Verbs, add_flag, add_graph_verb, add_list_verb, typed
from ros_cli.verbs import action_send_goal

BY_NODE = (get_action_client_names_and_types_by_node, get_action_server_names_and_types_by_node)


def add_verbs(verbs: Verbs) -> None:
    """Add the verbs of this group."""
    info = add_graph_verb(verbs, "info", print_info, "Print information about an action")
    info.add_argument("action_name", help="Name of the ROS action to get info (e.g. '/fibonacci')")
    add_flag(info, "-t", "--show-types", help="Additionally show the action type")
    add_flag(info, "-c", "--count", help="Only display the number of action clients and servers")
    listing = add_list_verb(
        verbs, "action", lambda command, _: dict(sorted(get_action_names_and_types(command.node)))
    )
    add_flag(listing, "-t", "--show-types", help="Additionally show the action type")
    action_send_goal.add_to(verbs)


def print_info(options: Namespace) -> None:
    """Print the nodes that have a client or a server of an action."""
    action = absolute(options.action_name)
    with CommandNode(options.spin_time) as command:

        def clients_and_servers() -> list[list[tuple[str, list[str]]]]:
            return [nodes_with(command, action, partial(by_node, command.node)) for by_node in BY_NODE]

        # The action's name is discovered before the names of its nodes.
        command.discover(lambda: any(clients_and_servers()))
        clients, servers = clients_and_servers()
    print(f"Action: {options.action_name}")
    for kind, nodes in (("clients", clients), ("servers", servers)):
        print(f"Action {kind}: {len(nodes)}")
        for node, types in () if options.count else nodes:
            print(f"    {typed(node, types) if options.show_types else node}")
