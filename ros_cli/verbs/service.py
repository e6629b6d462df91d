"""`ros2 service`: list, type, call."""

from __future__ import annotations

import time
from argparse import Namespace

from rclpy.client import Client

from ros_cli.command_node import CommandNode, absolute
from ros_cli.errors import unknown
from ros_cli.interface_types import full_type_name, interface_class
from ros_cli.servers import wait_for_node_of, wait_for_type
from ros_cli.verb import (
    Verbs,
    add_flag,
    add_graph_verb,
    add_list_verb,
    add_values,
    given_values,
    positive_float,
)
from ros_cli.yaml_values import message_from_yaml


def add_verbs(verbs: Verbs) -> None:
    """Add the verbs of this group."""
    call = add_graph_verb(verbs, "call", call_service, "Call a service")
    call.add_argument("service_name", help="Name of the ROS service to call to (e.g. '/add_two_ints')")
    call.add_argument("service_type", help="Type of the ROS service (e.g. 'std_srvs/srv/Empty')")
    add_values(call, "values", "Values to fill the service request with in YAML format (e.g. '{a: 1, b: 2}')")
    call.add_argument(
        "-r", "--rate", metavar="N", type=positive_float, help="Repeat the call at a specific rate in Hz"
    )
    listing = add_list_verb(
        verbs, "service", lambda command, options: command.services(hidden=options.include_hidden_services)
    )
    add_flag(listing, "-t", "--show-types", help="Additionally show the service type")
    add_flag(listing, "--include-hidden-services", help="Consider hidden services as well")
    type_of = add_graph_verb(verbs, "type", print_type, "Output a service's type")
    type_of.add_argument(
        "service_name", help="Name of the ROS service to get type (e.g. '/talker/list_parameters')"
    )


def print_type(options: Namespace) -> None:
    """Print the type of a service."""
    name = absolute(options.service_name)
    with CommandNode(options.spin_time) as command:
        if not command.find(lambda: name in command.services(), f"the service {name}"):
            raise unknown("service", name, command.services())
        print(*command.services()[name], sep="\n")


def call_service(options: Namespace) -> None:
    """Call a service, and print request and response."""
    service_type = interface_class(options.service_type, "srv")
    values = given_values(options)
    message_from_yaml(service_type.Request, values)  # report wrong values before waiting
    name = absolute(options.service_name)
    with CommandNode(options.spin_time) as command:
        client = command.node.create_client(service_type, name)
        _wait_for_service(command, client, name, full_type_name(options.service_type, "srv"))
        while True:
            called = time.monotonic()
            request = message_from_yaml(service_type.Request, values, now=command.now())
            print(f"requester: making request: {request!r}\n")
            print(f"response:\n{command.result(client.call_async(request))!r}\n")
            if options.rate is None:
                return
            time.sleep(max(0.0, called + 1 / options.rate - time.monotonic()))


def _wait_for_service(command: CommandNode, client: Client, name: str, wanted: str) -> None:
    if not command.find(client.service_is_ready):
        print("waiting for service to become available...")
        wait_for_type(command, client.service_is_ready, lambda: command.services().get(name, []), wanted)
    wait_for_node_of(command, name, command.node.get_service_names_and_types_by_node)
