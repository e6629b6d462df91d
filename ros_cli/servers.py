"""Waits, before a request is sent, until the server has the right type and its node can answer.

Discovery is not simultaneous: a request is lost if the server's node has not discovered this client yet.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from rclpy.node import NodeNameNonExistentError

from ros_cli.command_node import CommandNode, split_name
from ros_cli.errors import CommandError

SERVER_TIMEOUT = 2.0  # s; after that the request is sent anyway, since the node may only be busy

ByNode = Callable[[str, str], "list[tuple[str, list[str]]]"]  # takes a node's name and namespace


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
        CommandError: a server of this name has another type, so the wait would never end.
    """

    def is_ready_or_never() -> bool:
        others = [each for each in types() if each != wanted]
        if others and not is_ready():
            raise CommandError(
                f"The server has the type {', '.join(others)}, not {wanted}; give the server's type"
            )
        return is_ready()

    command.wait_until(is_ready_or_never)


def nodes_with(command: CommandNode, name: str, by_node: ByNode) -> list[tuple[str, list[str]]]:
    """Return the nodes that have an endpoint of this name, such as a service or an action's client, with its types.

    `by_node` returns the names and types of one node's endpoints of that kind.
    """
    found = []
    for node in command.node_names(hidden=True):
        try:
            types = dict(by_node(*split_name(node))).get(name)
        except NodeNameNonExistentError:  # the node has just ended
            continue
        if types is not None:
            found.append((node, types))
    return found


def wait_for_node_of(command: CommandNode, server: str, by_node: ByNode) -> None:
    """Wait until the node of a service or an action server answers requests."""
    for node, _ in nodes_with(command, server, by_node):
        if f"{node}/list_parameters" in command.services():
            command.wait_until_answering(node, SERVER_TIMEOUT)
