"""The commands of `course`; a command's module is imported only when that command runs.

Exit status of every command: 0 success, 1 failure, 2 unusable arguments.
To add a command, write <name>.py with a function of that name into its folder, and a line in COMMANDS.
"""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib import import_module
from importlib.util import find_spec
from typing import Any

import typer
from rich.console import Console
from typer.core import TyperGroup

from course_cli.ending import ended, in_a_sentence
from ros_runtime.course_error import CourseError
from ros_runtime.project import COURSE, PROJECT

HELP = "Learn ROS 2 services and actions on a humanoid that really balances."
FORWARDING = {"ignore_unknown_options": True, "allow_extra_args": True}
FOR_EVERYBODY, FOR_INSTRUCTORS = "course_cli.commands", "autograder.classroom.commands"
UTF8_VARIABLE = "PYTHONUTF8"  # of Python; its child processes read it, too


@dataclass(frozen=True)
class Command:
    """A command before its module is imported.

    Attributes:
        summary: its line in `course --help`.
        folder: the package that has its module; that of instructors is not in a student's archive.
        forwards_arguments: the command passes unknown arguments, in typer.Context.args, to another program.
        forwards_help: the command also passes --help to that program.
    """

    summary: str
    folder: str = FOR_EVERYBODY
    forwards_arguments: bool = False
    forwards_help: bool = True

    @property
    def settings(self) -> dict[str, Any]:
        """Typer's context settings: what the command parses itself and what it leaves in context.args."""
        if not self.forwards_arguments:
            return {}
        return FORWARDING | ({"help_option_names": []} if self.forwards_help else {})


COMMANDS: dict[str, Command] = {
    "demo": Command("See it all work: a walk, a cancel, three graded submissions.", FOR_INSTRUCTORS),
    "lab": Command("Open the chapters and exercises.", forwards_arguments=True, forwards_help=False),
    "check": Command("Check your own solution of an exercise."),
    "submit": Command("Write the files that you hand in, and see what they hold."),
    "sim": Command("The robot node alone.", forwards_arguments=True),
    "ros": Command(
        "The ros2 commands: topic, service, action, node, param, interface.", forwards_arguments=True
    ),
    "collect": Command("Read submissions from what a platform lets you download.", FOR_INSTRUCTORS),
    "grade": Command("Grade a batch of submissions.", FOR_INSTRUCTORS),
    "replay": Command("Show a recorded arena: in the web view, as a film, as text."),
    "merge": Command("Join the parts of a class that were graded apart.", FOR_INSTRUCTORS),
    "export": Command("Write the grades for another platform.", FOR_INSTRUCTORS),
    "package": Command("Make an autograder that another platform runs.", FOR_INSTRUCTORS),
    "gradescope": Command("In Gradescope's container: grade the upload.", FOR_INSTRUCTORS),
    "new": Command("Make the folder of a new exercise.", FOR_INSTRUCTORS),
    "release": Command("Write the students' archive.", FOR_INSTRUCTORS),
    "audit": Command("Grade submissions with known faults.", FOR_INSTRUCTORS),
    "book": Command("Make chapters, exercises and docs into a site for readers.", FOR_INSTRUCTORS),
    "bench": Command("Print the performance table.", FOR_INSTRUCTORS),
    "test": Command(
        "Run the tests, all or by tier.", FOR_INSTRUCTORS, forwards_arguments=True, forwards_help=False
    ),
}


def is_here(name: str) -> bool:
    """Return whether this copy of the course has the module of a command."""
    try:
        return find_spec(f"{COMMANDS[name].folder}.{name}") is not None
    except ModuleNotFoundError:  # of the folder
        return False


def load(name: str) -> Any:
    """Import the module of a command, and return what it has under the command's name: a function, or a typer.Typer."""
    return getattr(import_module(f"{COMMANDS[name].folder}.{name}"), name)


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command that `arguments` (default: the process's own) name, and exit with its status.

    A program that a script starts in the background (`course grade … &`) ignores SIGINT, and so would its child
    processes, such as students' nodes. Therefore the default handler of SIGINT is restored first.
    """
    signal.signal(signal.SIGINT, signal.default_int_handler)
    if arguments is None:
        _require_utf8()
    if COURSE != PROJECT:
        _keep_work()
    arguments = sys.argv[1:] if arguments is None else list(arguments)
    chosen = next((word for word in arguments if not word.startswith("-")), None)
    try:
        app(chosen)(args=list(arguments), prog_name="course")
    except Exception as error:
        if sentence := in_a_sentence(error):
            sys.exit(sentence)
        raise


def _keep_work() -> None:
    """Copy the notebooks of a student's copy of the course, or put them back, and print which were put back."""
    from course_cli.kept_work import keep_work

    if os.access(COURSE, os.W_OK):
        for sentence in keep_work():
            print(f"course: {sentence}", file=sys.stderr)


def _require_utf8() -> None:
    """Start again in Python's UTF-8 mode where the locale has no UTF-8: students' names and texts need it."""
    if sys.getfilesystemencoding() != "utf-8" and os.environ.get(UTF8_VARIABLE) != "1":
        os.environ[UTF8_VARIABLE] = "1"
        os.execv(sys.executable, [sys.executable, *sys.orig_argv[1:]])


class _Course(TyperGroup):
    """Prints the message of a `CourseError` and exits with its status."""

    def invoke(self, ctx: Any) -> Any:
        try:
            return super().invoke(ctx)
        except CourseError as error:
            raise ended(Console(highlight=False), error, error.exit_status) from error


def app(chosen: str | None) -> typer.Typer:
    """Return the application with every command listed, and only `chosen` imported."""
    course = typer.Typer(
        cls=_Course, help=HELP, no_args_is_help=True, add_completion=False, pretty_exceptions_enable=False
    )
    for name, command in COMMANDS.items():
        if not is_here(name):
            continue
        target = load(name) if name == chosen else _listed_only(command.summary)
        if isinstance(target, typer.Typer):
            course.add_typer(target, name=name, help=command.summary)
        else:
            course.command(name, context_settings=command.settings)(target)
    # With a single command Typer would drop its name; a callback keeps it.
    course.callback()(lambda: None)
    return course


def _listed_only(summary: str) -> Callable[[], None]:
    """Return a placeholder that lists a command in the help without importing its module."""

    def listed() -> None: ...

    listed.__doc__ = summary
    return listed
