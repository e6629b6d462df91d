"""Adds verbs and their common arguments to the command line."""

from __future__ import annotations

import os
import sys
from argparse import ArgumentParser, ArgumentTypeError, Namespace
from collections.abc import Callable, Collection, Mapping, Sequence
from typing import Any

from ros_cli.command_node import SPIN_TIME, CommandNode
from ros_cli.errors import print_message, transient_message
from ros_runtime import notebook_domains

Verbs = Any  # what ArgumentParser.add_subparsers() returns; argparse keeps its class private
Run = Callable[[Namespace], "int | None"]


def add_verb(verbs: Verbs, name: str, run: Run, summary: str) -> ArgumentParser:
    """Add a verb; `run` gets the parsed arguments and returns the exit status, None for 0."""
    parser = verbs.add_parser(name, help=summary, description=summary)
    parser.set_defaults(run=run)
    return parser


def add_graph_verb(verbs: Verbs, name: str, run: Run, summary: str) -> ArgumentParser:
    """Add a verb that first discovers the ROS graph."""
    parser = add_verb(verbs, name, run, summary)
    parser.add_argument(
        "--spin-time",
        type=positive_float,
        default=SPIN_TIME,
        help="Spin time in seconds: discovery ends when nothing new has appeared for this long",
    )
    add_flag(parser, "--no-daemon", help="Accepted for scripts; there is no daemon here")
    return parser


def add_list_verb(
    verbs: Verbs, kind: str, names: Callable[[CommandNode, Namespace], Collection[str]]
) -> ArgumentParser:
    """Add the verb that prints all names of a kind, such as "topic", one on each line, or their number.

    `names` is called after discovery. If it returns a mapping from names to types, --show-types prints the types.
    """

    def print_list(options: Namespace) -> None:
        with transient_message("discovering nodes …"), CommandNode(options.spin_time) as command:
            command.discover(command.is_beside_others)
            found, is_alone = names(command, options), not command.is_beside_others()
        if is_alone:
            print_message(_no_node())
        if options.count:
            print(len(found))
            return
        types = found if isinstance(found, Mapping) and options.show_types else {}
        for name in found:
            print(typed(name, types[name]) if types else name)

    listing = add_graph_verb(verbs, "list", print_list, f"Output a list of available {kind}s")
    words = f"Only display the number of {kind}s discovered"
    listing.add_argument("-c", f"--count-{kind}s", dest="count", action="store_true", help=words)
    return listing


def _no_node() -> str:
    """Return that the domain has no other node, and where the lab's nodes are."""
    seen = f"No node was found in ROS domain {os.environ.get('ROS_DOMAIN_ID') or 0}."
    if notebook_domains.is_in_a_lab():
        return f"{seen} Next: start the robot or a node in a notebook."
    return f"{seen} Nodes of a notebook are in its own domain. Next: type this in a terminal of JupyterLab."


def add_flag(parser: ArgumentParser, *names: str, help: str) -> None:
    """Add an option without a value."""
    parser.add_argument(*names, action="store_true", help=help)


def add_values(parser: ArgumentParser, metavar: str, summary: str) -> None:
    """Add the argument for a message's fields in YAML, or --stdin instead of it; `given_values` returns the YAML."""
    group = parser.add_mutually_exclusive_group()
    group.add_argument(
        "values",
        metavar=metavar,
        nargs="?",
        default="{}",
        help=f"{summary}; 'header: auto' and a time's 'now' stand for the time of sending",
    )
    group.add_argument("--stdin", action="store_true", help="Read values from standard input")


def given_values(options: Namespace) -> str:
    """Return the YAML from the command line or from standard input."""
    return sys.stdin.read() if options.stdin else str(options.values)


def typed(name: str, types: Sequence[str]) -> str:
    """Return a name with its types, as --show-types prints it."""
    return f"{name} [{', '.join(types)}]"


def positive_float(text: str) -> float:
    """Parse a positive number for argparse."""
    try:
        number = float(text)
    except ValueError:
        raise ArgumentTypeError(f"{text!r} is not a number") from None
    if number <= 0:
        raise ArgumentTypeError(f"{text} is not positive")
    return number


def natural_number(text: str) -> int:
    """Parse a whole number (0, 1, 2, …) for argparse."""
    if not text.isdecimal():
        raise ArgumentTypeError(f"{text!r} is not a whole number (0, 1, 2, …)")
    return int(text)


def positive_int(text: str) -> int:
    """Parse a positive whole number for argparse."""
    if (number := natural_number(text)) == 0:
        raise ArgumentTypeError("0 is not positive")
    return number
