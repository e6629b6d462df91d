"""The command line: `ros2 GROUP VERB …`, parsed as ros2cli does.

Exit statuses as of ros2cli: 0 the command succeeded, 1 it failed, 2 unusable arguments or Ctrl-C.
"""

from __future__ import annotations

import os
import signal
import sys
from argparse import ArgumentParser
from collections.abc import Sequence
from typing import Any

from ros_cli.errors import CommandError, print_message
from ros_cli.real_ros2 import real_ros2
from ros_cli.verbs import action, interface, node, param, service, topic
from ros_runtime import notebook_domains
from ros_runtime.ros_domain import require_usable_domain

GROUPS = {
    "action": (action, "Various action related sub-commands"),
    "interface": (interface, "Show information about ROS interfaces"),
    "node": (node, "Various node related sub-commands"),
    "param": (param, "Various param related sub-commands"),
    "service": (service, "Various service related sub-commands"),
    "topic": (topic, "Various topic related sub-commands"),
}

HELP = """\
Names are full names, such as /robot/odom. A command uses the ROS domain ROS_DOMAIN_ID of the shell, or 0 if it
is not set. In the lab, a cell uses the domain of its own notebook; a terminal uses that of the notebook whose
robot or node was started last, unless ROS_DOMAIN_ID is set there."""


def main(arguments: Sequence[str] | None = None, *, program: str = "ros2") -> int:
    """Run a command, with the real ros2 if that is on the PATH, and return the exit status."""
    arguments = list(sys.argv[1:] if arguments is None else arguments)
    try:
        join_domain()
    except CommandError as error:
        print_message(error)
        return 1
    if (real := real_ros2()) is not None:
        os.execv(real, [real, *arguments])
    return run(arguments, program)


def run(arguments: Sequence[str], program: str = "ros2") -> int:
    """Run a command of the course and return the exit status."""
    options = command_line(program).parse_args(arguments)
    if hasattr(sys.stdout, "reconfigure"):
        sys.stdout.reconfigure(line_buffering=True)  # flush every line, also into a pipe
    try:
        return options.run(options) or 0
    except CommandError as error:
        print_message(error)
        return 1
    except KeyboardInterrupt:
        return signal.SIGINT
    except BrokenPipeError:  # the reader has closed the pipe, as `… | head` does
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1


def join_domain() -> None:
    """In the lab, set ROS_DOMAIN_ID of this process to a notebook's domain, unless it is set already.

    Raises CommandError if ROS_DOMAIN_ID is not a usable domain.
    """
    domain_id = notebook_domains.latest()
    if domain_id is not None:
        os.environ.setdefault("ROS_DOMAIN_ID", str(domain_id))
    try:
        require_usable_domain()
    except ValueError as error:
        raise CommandError(str(error)) from error


def command_line(program: str) -> ArgumentParser:
    """Return the parser of all groups and verbs; the parsed options have `run`, a function that takes the options."""
    look: dict[str, Any] = {"epilog": HELP}
    words = "The ros2 commands that the course uses, with the words and the output of ros2cli."
    parser = ArgumentParser(prog=program, description=words, **look)
    _show_help_without_verb(parser)
    groups = parser.add_subparsers(title="Commands", metavar="COMMAND")
    for name, (module, summary) in GROUPS.items():
        group = groups.add_parser(name, help=summary, description=summary, **look)
        _show_help_without_verb(group)
        module.add_verbs(group.add_subparsers(title="Verbs", metavar="VERB"))
    return parser


def _show_help_without_verb(parser: ArgumentParser) -> None:
    parser.set_defaults(run=lambda _: parser.print_help())
