"""Waits before a request until the server has the right type and its node can answer.

Discovery is not simultaneous: a request is lost if the server's node has not discovered this client yet.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from rclpy.action import get_action_server_names_and_types_by_node
from rclpy.node import NodeNameNonExistentError

from ros_cli.command_node import CommandNode, full_name
from ros_cli.errors import CommandError

SERVER_TIMEOUT = 2.0  # s; after that the request is sent anyway, since the node may only be busy

NamesAndTypes = list[tuple[str, list[str]]]


def wait_for_type(
    command: CommandNode, is_ready: Callable[[], bool], types: Callable[[], Sequence[str]], wanted: str
) -> None:
    """Wait until a server is ready.

    Args:
        command: the node that queries the graph.
        is_ready: returns whether a server of the wanted type exists.
        types: returns all types of this name in the graph, including this client's.
        wanted: the type of this client.

    Raises:
        CommandError: the name exists with another type only, so the wait would never end.
    """

    def is_ready_or_never() -> bool:
        others = [each for each in types() if each != wanted]
        if others and not is_ready():
            raise CommandError(f"It has the type {', '.join(others)}, not {wanted}; give the type it has")
        return is_ready()

    command.wait_until(is_ready_or_never)


def wait_for_service_node(command: CommandNode, service: str) -> None:
    """Wait until the node that has a service answers."""
    _wait(command, service, command.node.get_service_names_and_types_by_node)


def wait_for_action_node(command: CommandNode, action: str) -> None:
    """Wait until the node that has an action's server answers."""
    _wait(
        command,
        action,
        lambda name, namespace: get_action_server_names_and_types_by_node(command.node, name, namespace),
    )


def _wait(command: CommandNode, server: str, servers_of: Callable[[str, str], NamesAndTypes]) -> None:
    for name, namespace in command.node.get_node_names_and_namespaces():
        try:
            names = [each for each, _ in servers_of(name, namespace)]
        except NodeNameNonExistentError:
            continue
        node = full_name(name, namespace)
        if server in names and f"{node}/list_parameters" in command.services():
            command.wait_until_answering(node, SERVER_TIMEOUT)
