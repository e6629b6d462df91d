"""The commands of `course`; a command's module is imported only when that command runs.

Exit status of every command: 0 success, 1 failure, 2 unusable arguments.
To add a command, write course_cli/commands/<name>.py and a line in COMMANDS.
"""

from __future__ import annotations

import signal
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib import import_module
from importlib.util import find_spec
from typing import Any

import typer

from course_cli.ending import FULL_DISK, is_a_full_disk

HELP = "Learn ROS 2 services and actions on a humanoid that really balances."
FORWARDING = {"ignore_unknown_options": True, "allow_extra_args": True}


@dataclass(frozen=True)
class Command:
    """A command before its module is imported.

    Attributes:
        target: "module:name" of a function written for Typer, or of a typer.Typer with subcommands.
        summary: its line in `course --help`.
        forwards_arguments: it passes unknown arguments, in typer.Context.args, to another program.
        forwards_help: it passes --help to that program, too.
    """

    target: str
    summary: str
    forwards_arguments: bool = False
    forwards_help: bool = True

    @property
    def module(self) -> str:
        """The module in which the command is."""
        return self.target.partition(":")[0]

    @property
    def settings(self) -> dict[str, Any]:
        """Typer's context settings: what the command parses itself and what it leaves in context.args."""
        if not self.forwards_arguments:
            return {}
        return FORWARDING | ({"help_option_names": []} if self.forwards_help else {})

    def load(self) -> Any:
        """Import the module and return what `target` names in it."""
        return getattr(import_module(self.module), self.target.partition(":")[2])


COMMANDS: dict[str, Command] = {
    "demo": Command(
        "course_cli.commands.demo:demo", "See it all work: a walk, a cancel, three graded submissions."
    ),
    "lab": Command(
        "course_cli.commands.lab:lab",
        "Open the chapters and exercises.",
        forwards_arguments=True,
        forwards_help=False,
    ),
    "check": Command("course_cli.commands.check:check", "Check your own solution of an exercise."),
    "sim": Command("course_cli.commands.sim:sim", "The robot node alone.", forwards_arguments=True),
    "ros": Command(
        "course_cli.commands.ros:ros",
        "The ros2 commands: topic, service, action, node, param, interface.",
        forwards_arguments=True,
    ),
    "collect": Command(
        "course_cli.commands.collect:collect", "Read submissions from what a platform lets you download."
    ),
    "grade": Command("course_cli.commands.grade:grade", "Grade a batch of submissions."),
    "replay": Command(
        "course_cli.commands.replay:replay", "Show a recorded arena: in the web view, as a film, as text."
    ),
    "merge": Command("course_cli.commands.merge:merge", "Join the parts of a class that were graded apart."),
    "export": Command("course_cli.commands.export:export", "Write the grades for another platform."),
    "package": Command(
        "course_cli.commands.package:package", "Make an autograder that another platform runs."
    ),
    "gradescope": Command(
        "course_cli.commands.gradescope:gradescope", "In Gradescope's container: grade the upload."
    ),
    "new": Command("course_cli.commands.new:new", "Make the folder of a new exercise."),
    "release": Command("course_cli.commands.release:release", "Write the students' archive."),
    "audit": Command("course_cli.commands.audit:audit", "Grade submissions with known faults."),
    "book": Command(
        "course_cli.commands.book:book", "Make chapters, exercises and docs into a site for readers."
    ),
    "bench": Command("course_cli.commands.bench:bench", "Print the performance table."),
    "test": Command(
        "course_cli.commands.test:run_tests",
        "Run the tests, all or by tier.",
        forwards_arguments=True,
        forwards_help=False,
    ),
}


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command that `arguments` (default: the process's own) name, and exit with its status.

    A program that a script starts in the background (`course grade … &`) ignores Ctrl-C, and so would all that it
    starts, students' nodes among them; so Ctrl-C is put back to what it does in a terminal.
    """
    signal.signal(signal.SIGINT, signal.default_int_handler)
    arguments = sys.argv[1:] if arguments is None else list(arguments)
    chosen = next((word for word in arguments if not word.startswith("-")), None)
    try:
        app(chosen)(args=list(arguments), prog_name="course")
    except Exception as error:
        if not is_a_full_disk(error):
            raise
        sys.exit(FULL_DISK)


def app(chosen: str | None) -> typer.Typer:
    """Return the application with every command listed, and only `chosen` imported."""
    course = typer.Typer(
        help=HELP, no_args_is_help=True, add_completion=False, pretty_exceptions_enable=False
    )
    for name, command in COMMANDS.items():
        if find_spec(command.module) is None:
            continue
        target = command.load() if name == chosen else _listed_only(command.summary)
        if isinstance(target, typer.Typer):
            course.add_typer(target, name=name, help=command.summary)
        else:
            course.command(name, context_settings=command.settings)(target)
    # With a single command Typer would drop its name; a callback keeps it.
    course.callback()(lambda: None)
    return course


def _listed_only(summary: str) -> Callable[[], None]:
    """Return a placeholder for a command that this run does not call, so that help can list it."""

    def listed() -> None: ...

    listed.__doc__ = summary
    return listed
