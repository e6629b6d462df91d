"""`ros2 action`: list, info and send_goal."""

from __future__ import annotations

from argparse import Namespace
from functools import partial
from queue import SimpleQueue
from typing import Any

from rclpy.action import (
    ActionClient,
    get_action_client_names_and_types_by_node,
    get_action_names_and_types,
    get_action_server_names_and_types_by_node,
)
from rclpy.task import Future

from ros_cli.command_node import CommandNode, absolute
from ros_cli.errors import CommandError
from ros_cli.interface_types import full_type_name, interface_class
from ros_cli.servers import nodes_with, wait_for_node_of, wait_for_type
from ros_cli.verb import Verbs, add_flag, add_graph_verb, add_list_verb, add_values, given_values, typed
from ros_cli.yaml_values import message_from_yaml, message_to_yaml
from ros_runtime.message_constants import GoalStatus, name_of

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
    _add_send_goal(verbs)


def print_info(options: Namespace) -> None:
    """Print the nodes that have a client or a server of an action."""
    action = absolute(options.action_name)
    with CommandNode(options.spin_time) as command:

        def clients_and_servers() -> list[list[tuple[str, list[str]]]]:
            return [nodes_with(command, action, partial(by_node, command.node)) for by_node in BY_NODE]

        # The action's name is discovered before the names of its nodes.
        command.discover(lambda: any(clients_and_servers()), f"the action {action}")
        clients, servers = clients_and_servers()
    print(f"Action: {options.action_name}")
    for kind, nodes in (("clients", clients), ("servers", servers)):
        print(f"Action {kind}: {len(nodes)}")
        for node, types in () if options.count else nodes:
            print(f"    {typed(node, types) if options.show_types else node}")


def _add_send_goal(verbs: Verbs) -> None:
    send_goal = add_graph_verb(verbs, "send_goal", send, "Send an action goal")
    send_goal.add_argument("action_name", help="Name of the ROS action (e.g. '/fibonacci')")
    send_goal.add_argument(
        "action_type", help="Type of the ROS action (e.g. 'example_interfaces/action/Fibonacci')"
    )
    add_values(send_goal, "goal", "Goal request values in YAML format (e.g. '{order: 10}')")
    add_flag(send_goal, "-f", "--feedback", help="Echo feedback messages for the goal")


def send(options: Namespace) -> None:
    """Send a goal and print its feedback and result; Ctrl-C cancels it, a second one ends the wait for its result."""
    action_type = interface_class(options.action_type, "action")
    values = given_values(options)
    message_from_yaml(action_type.Goal, values)  # report wrong values before waiting
    with CommandNode(options.spin_time) as command:
        client = ActionClient(command.node, action_type, absolute(options.action_name))
        _wait_for_server(command, client, options)
        goal = message_from_yaml(action_type.Goal, values, now=command.now())
        print(f"Sending goal:\n     {message_to_yaml(goal)}")
        sent = _SentGoal(command, client, goal, feedback=options.feedback)
        try:
            sent.follow()
        except KeyboardInterrupt:
            sent.cancel()
            sent.follow()


def _wait_for_server(command: CommandNode, client: ActionClient, options: Namespace) -> None:
    name, wanted = absolute(options.action_name), full_type_name(options.action_type, "action")
    print("Waiting for an action server to become available...")
    wait_for_type(
        command,
        client.server_is_ready,
        lambda: dict(get_action_names_and_types(command.node)).get(name, []),
        wanted,
    )
    wait_for_node_of(command, name, partial(get_action_server_names_and_types_by_node, command.node))


class _SentGoal:
    """A goal that was sent."""

    def __init__(self, command: CommandNode, client: ActionClient, goal: Any, *, feedback: bool) -> None:
        self._command = command
        # feedback messages; the last item is the result's future
        self._updates: SimpleQueue[Any] = SimpleQueue()
        on_feedback = self._updates.put if feedback else None
        self._answer: Future = command.run_in_spin(lambda: client.send_goal_async(goal, on_feedback))
        self._result: Future | None = None

    def follow(self) -> None:
        """Print the server's answer, the feedback and the result as they arrive; a second call continues the first."""
        handle = self._command.result(self._answer)
        if not handle.accepted:
            print("Goal was rejected.")
            return
        if self._result is None:
            print(f"Goal accepted with ID: {bytes(handle.goal_id.uuid).hex()}\n")
            self._result = self._command.run_in_spin(handle.get_result_async)
            self._result.add_done_callback(self._updates.put)
        while (update := self._updates.get()) is not self._result:
            print(f"Feedback:\n    {message_to_yaml(update.feedback)}")
        end = self._result.result()
        print(f"Result:\n    {message_to_yaml(end.result)}")
        print(f"Goal finished with status: {name_of(GoalStatus, end.status)}")

    def cancel(self) -> None:
        """Cancel the goal, unless it was rejected or has ended."""
        handle = self._command.result(self._answer)
        if not handle.accepted or (self._result and self._result.done()):
            return
        print("Canceling goal...")
        response = self._command.result(self._command.run_in_spin(handle.cancel_goal_async))
        if not response.goals_canceling:
            raise CommandError(
                "Failed to cancel goal: the server refused; its cancel_callback has to return CancelResponse.ACCEPT, "
                "and a goal that has ended cannot be canceled"
            )
        print("Goal canceled.")
