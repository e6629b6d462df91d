"""`ros2 action send_goal`: a goal, its feedback and its result; Ctrl-C cancels it."""

from __future__ import annotations

from argparse import Namespace
from queue import SimpleQueue
from typing import Any

from rclpy.action import ActionClient, get_action_names_and_types
from rclpy.action.client import ClientGoalHandle
from rclpy.task import Future

from ros_cli.command_node import CommandNode, absolute
from ros_cli.errors import CommandError
from ros_cli.interface_types import full_type_name, interface_class
from ros_cli.servers import wait_for_action_node, wait_for_type
from ros_cli.verb import Verbs, add_graph_verb
from ros_cli.yaml_values import message_from_yaml, message_to_yaml
from ros_runtime.message_constants import GoalStatus, name_of


def add_to(verbs: Verbs) -> None:
    """Add the verb."""
    send_goal = add_graph_verb(verbs, "send_goal", send, "Send an action goal")
    send_goal.add_argument("action_name", help="Name of the ROS action (e.g. '/fibonacci')")
    send_goal.add_argument(
        "action_type", help="Type of the ROS action (e.g. 'example_interfaces/action/Fibonacci')"
    )
    send_goal.add_argument(
        "goal", nargs="?", default="{}", help="Goal request values in YAML format (e.g. '{order: 10}')"
    )
    send_goal.add_argument(
        "-f", "--feedback", action="store_true", help="Echo feedback messages for the goal"
    )


def send(options: Namespace) -> None:
    """Send a goal and print what comes of it; Ctrl-C cancels it.

    Raises:
        CommandError: the type or the values are wrong, or the cancel was refused.
    """
    action_type = interface_class(options.action_type, "action")
    goal = message_from_yaml(action_type.Goal, options.goal)
    with CommandNode(options.spin_time) as command:
        client = ActionClient(command.node, action_type, absolute(options.action_name))
        _wait_for_server(command, client, options)
        print(f"Sending goal:\n     {message_to_yaml(goal)}")
        updates: SimpleQueue[Any] = SimpleQueue()  # feedback, and at last the future of the result
        on_feedback = updates.put if options.feedback else None
        answer = command.run_in_spin(lambda: client.send_goal_async(goal, on_feedback))
        try:
            _print_course(command, answer, updates)
        except KeyboardInterrupt:
            _cancel(command, command.result(answer))
            raise


def _wait_for_server(command: CommandNode, client: ActionClient, options: Namespace) -> None:
    name, wanted = absolute(options.action_name), full_type_name(options.action_type, "action")
    print("Waiting for an action server to become available...")
    wait_for_type(
        command,
        client.server_is_ready,
        lambda: dict(get_action_names_and_types(command.node)).get(name, []),
        wanted,
    )
    wait_for_action_node(command, name)


def _print_course(command: CommandNode, answer: Future, updates: SimpleQueue[Any]) -> None:
    """Print the server's answer, the feedback and the result, as they come."""
    handle = command.result(answer)
    if not handle.accepted:
        print("Goal was rejected.")
        return
    print(f"Goal accepted with ID: {bytes(handle.goal_id.uuid).hex()}\n")
    result = command.run_in_spin(handle.get_result_async)
    result.add_done_callback(updates.put)
    while (update := updates.get()) is not result:
        print(f"Feedback:\n    {message_to_yaml(update.feedback)}")
    print(f"Result:\n    {message_to_yaml(result.result().result)}")
    print(f"Goal finished with status: {name_of(GoalStatus, result.result().status)}")


def _cancel(command: CommandNode, handle: ClientGoalHandle) -> None:
    if not handle.accepted:
        return
    print("Canceling goal...")
    response = command.result(command.run_in_spin(handle.cancel_goal_async))
    if not response.goals_canceling:
        raise CommandError(
            "Failed to cancel goal: the server refused; its cancel_callback has to return CancelResponse.ACCEPT, "
            "and a goal that has ended cannot be canceled"
        )
    print("Goal canceled.")
