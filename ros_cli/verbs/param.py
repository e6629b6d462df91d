"""`ros2 param`: list, describe, get, set, dump, load."""

from __future__ import annotations

import sys
from argparse import ArgumentParser, Namespace
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import yaml
from rcl_interfaces.msg import Parameter, ParameterDescriptor, ParameterType, ParameterValue
from rclpy.parameter import get_parameter_value, parameter_dict_from_yaml_file, parameter_value_to_python
from rclpy.parameter_client import AsyncParameterClient

from ros_cli.command_node import CommandNode, absolute
from ros_cli.errors import CommandError, unknown
from ros_cli.verb import Run, Verbs, add_flag, add_graph_verb, positive_float

ANSWER_TIMEOUT = 5.0  # s
# The index is the constant in rcl_interfaces/ParameterType.
TYPES = (
    *("not set", "boolean", "integer", "double", "string"),
    *("byte array", "boolean array", "integer array", "double array", "string array"),
)


def add_verbs(verbs: Verbs) -> None:
    """Add the verbs of this group."""
    words = "Show descriptive information about declared parameters"
    describe = _of_one_node(verbs, "describe", print_descriptions, words)
    describe.add_argument("parameter_names", nargs="+", help="Names of the parameters")
    _of_one_node(verbs, "dump", dump, "Show all of the parameters of a node in a YAML file format")
    get = _of_one_node(verbs, "get", print_value, "Get parameter")
    get.add_argument("parameter_name", help="Name of the parameter")
    add_flag(get, "--hide-type", help="Hide the type information")
    listing = add_graph_verb(verbs, "list", print_list, "Output a list of available parameters")
    listing.add_argument("node_name", nargs="?", help="Name of the ROS node")
    load = _of_one_node(verbs, "load", load_file, "Load parameter file for a node")
    load.add_argument("parameter_file", help="Parameter file")
    set_value = _of_one_node(verbs, "set", set_parameter, "Set parameter")
    set_value.add_argument("parameter_name", help="Name of the parameter")
    set_value.add_argument("value", help="Value of the parameter")


def print_list(options: Namespace) -> None:
    """Print the names of the parameters of one node or of all nodes."""
    with CommandNode(options.spin_time) as command:
        wanted = absolute(options.node_name) if options.node_name else None
        command.discover(lambda: wanted is None or wanted in command.node_names())
        names = command.node_names()
        if wanted and wanted not in names:
            raise _not_found(wanted, names)
        for name in [wanted] if wanted else names:
            _print_names(command, name, with_title=wanted is None)


def print_descriptions(options: Namespace) -> None:
    """Print the type, the description and the constraints of parameters."""
    with _node_of(options) as (command, client):
        descriptors = command.result(client.describe_parameters(options.parameter_names)).descriptors
    if not descriptors:
        raise CommandError(
            f"Not all of {', '.join(options.parameter_names)} are declared; `param list` shows those that are"
        )
    for descriptor in descriptors:
        print(description_lines(descriptor))


def print_value(options: Namespace) -> None:
    """Print the value of a parameter."""
    with _node_of(options) as (command, client):
        response = command.result(client.get_parameters([options.parameter_name]))
    if not response.values:
        raise CommandError(
            f"Parameter not set: {options.parameter_name!r}; `param list` shows the node's parameters"
        )
    print(value_line(response.values[0], with_label=not options.hide_type))


def set_parameter(options: Namespace) -> None:
    """Set a parameter, and print whether the node accepted it; as with ros2cli, a rejection has exit status 0."""
    parameter = Parameter(name=options.parameter_name, value=_typed(options.value))
    with _node_of(options) as (command, client):
        result = command.result(client.set_parameters([parameter])).results[0]
    _print_outcome("Set parameter successful" if result.successful else "Setting parameter failed", result)


def dump(options: Namespace) -> None:
    """Print the parameters of a node as a file that `param load` and --params-file read."""
    with _node_of(options) as (command, client):
        names = sorted(command.result(client.list_parameters()).result.names)
        values = command.result(client.get_parameters(names)).values
    parameters = {name: parameter_value_to_python(value) for name, value in zip(names, values, strict=True)}
    print(as_file(absolute(options.node_name), parameters))


def load_file(options: Namespace) -> None:
    """Set the parameters of a file, and print for each whether the node accepted it."""
    parameters = _parameters_of(options.parameter_file)
    with _node_of(options) as (command, client):
        results = command.result(client.set_parameters(parameters)).results
    for parameter, result in zip(parameters, results, strict=True):
        outcome = "successful" if result.successful else "failed"
        _print_outcome(f"Set parameter {parameter.name} {outcome}", result)


def value_line(value: ParameterValue, *, with_label: bool = True) -> str:
    """Return the line that `param get` prints for a value."""
    if value.type == ParameterType.PARAMETER_NOT_SET:
        return "Parameter not set." if with_label else "None"
    text = str(parameter_value_to_python(value))
    kind, _, many = TYPES[value.type].partition(" ")
    return f"{kind.capitalize()} {'values are' if many else 'value is'}: {text}" if with_label else text


def description_lines(descriptor: ParameterDescriptor) -> str:
    """Return the lines that `param describe` prints for a parameter."""
    lines = [f"Parameter name: {descriptor.name}", f"  Type: {TYPES[descriptor.type]}"]
    if descriptor.description:
        lines.append(f"  Description: {descriptor.description}")
    lines.append("  Constraints:")
    if descriptor.read_only:
        lines.append("    Read only: true")
    for limits in [*descriptor.floating_point_range, *descriptor.integer_range][:1]:
        lines += [f"    Min value: {limits.from_value}", f"    Max value: {limits.to_value}"]
        if limits.step:
            lines.append(f"    Step: {limits.step}")
    if descriptor.additional_constraints:
        lines.append(f"    Additional constraints: {descriptor.additional_constraints}")
    return "\n".join(lines)


def as_file(node: str, parameters: dict[str, Any]) -> str:
    """Return parameters as the text of a parameter file; each dot in a name begins a nested mapping."""
    tree: dict[str, Any] = {}
    for name, value in parameters.items():
        *levels, last = name.split(".")
        branch = tree
        for level in levels:
            branch = branch.setdefault(level, {})
        branch[last] = value
    return yaml.dump({node: {"ros__parameters": tree}}, default_flow_style=False)


def _of_one_node(verbs: Verbs, name: str, run: Run, summary: str) -> ArgumentParser:
    verb = add_graph_verb(verbs, name, run, summary)
    verb.add_argument("node_name", help="Name of the ROS node")
    verb.add_argument(
        "--timeout",
        metavar="N",
        type=positive_float,
        default=1,
        help="Wait for N seconds until node becomes available (default %(default)s sec)",
    )
    return verb


@contextmanager
def _node_of(options: Namespace) -> Iterator[tuple[CommandNode, AsyncParameterClient]]:
    """Yield a command node and a client of the node's parameters, once that node answers."""
    name = absolute(options.node_name)
    with CommandNode(options.spin_time) as command:
        command.find(lambda: name in command.node_names(hidden=True), f"the node {name}")
        if not command.wait_until(lambda: name in command.node_names(hidden=True), options.timeout):
            raise _not_found(name, command.node_names())
        yield command, _client(command, name)


def _client(command: CommandNode, node: str) -> AsyncParameterClient:
    """Return a client of a node's parameters that the node answers."""
    if command.find(lambda: f"{node}/list_parameters" in command.services()):
        client = AsyncParameterClient(command.node, node)
        is_ready = command.wait_until(client.services_are_ready, ANSWER_TIMEOUT)
        if is_ready and command.wait_until_answering(node, ANSWER_TIMEOUT):
            return client
    raise CommandError(
        f"Wait for service timed out waiting for parameter services for node {node}: it has none or is not spinning"
    )


def _print_names(command: CommandNode, node: str, *, with_title: bool) -> None:
    try:
        client = _client(command, node)
    except CommandError as error:
        print(error)
        return
    names = sorted(command.result(client.list_parameters()).result.names)
    if with_title and names:
        print(f"{node}:")
    for name in names:
        print(f"  {name}")


def _typed(text: str) -> ParameterValue:
    try:
        return get_parameter_value(string_value=text)
    except (yaml.YAMLError, AssertionError) as error:
        raise CommandError(f"{text!r} is not a value for a parameter: {error}") from error


def _parameters_of(path: str) -> Sequence[Parameter]:
    try:
        return list(parameter_dict_from_yaml_file(path, True).values())
    except (OSError, RuntimeError, TypeError, yaml.YAMLError) as error:
        raise CommandError(
            f"{path} cannot be loaded: {error}; expected a file such as the output of `param dump`"
        ) from error


def _print_outcome(outcome: str, result: Any) -> None:
    reason = f": {result.reason}" if result.reason else ""
    print(outcome + reason, file=sys.stdout if result.successful else sys.stderr)


def _not_found(name: str, names: Sequence[str]) -> CommandError:
    return CommandError(f"Node not found. {unknown('node', name, names)}")
