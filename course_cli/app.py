"""The commands of `course`; a command's module is imported only when that command runs.

Exit status of every command: 0 success, 1 failure, 2 unusable arguments.
To add a command, create <name>.py with a function <name> in the folder of commands, and add a line to COMMANDS.
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
from typer.core import TyperGroup

from autograder.report.console import LineConsole
from course_cli.ending import user_message
from ros_runtime.course_error import CourseError
from ros_runtime.project import COURSE, PROJECT

HELP = "Learn ROS 2 services and actions on a humanoid that really balances."
FORWARDING = {"ignore_unknown_options": True, "allow_extra_args": True}
FOR_EVERYBODY, FOR_INSTRUCTORS = "course_cli.commands", "autograder.classroom.commands"
FOR_DEVELOPERS = "developer"  # in tests/, which only a clone has
UTF8_VARIABLE = "PYTHONUTF8"  # read by Python and inherited by its child processes


@dataclass(frozen=True)
class Command:
    """A command before its module is imported.

    Attributes:
        summary: the command's line in `course --help`.
        folder: the package with the command's module; the students' archive has only the first of the three packages.
        forwards_arguments: the command passes unknown arguments, in typer.Context.args, to another program.
        forwards_help: the command also passes --help to that program.
    """

    summary: str
    folder: str = FOR_EVERYBODY
    forwards_arguments: bool = False
    forwards_help: bool = True

    @property
    def settings(self) -> dict[str, Any]:
        """Typer's context settings, which decide whether unknown arguments and --help stay in context.args."""
        if not self.forwards_arguments:
            return {}
        return FORWARDING | ({"help_option_names": []} if self.forwards_help else {})


COMMANDS: dict[str, Command] = {
    "demo": Command(
        "Show the whole toolkit at work: a walk, a cancel, three graded submissions.", FOR_INSTRUCTORS
    ),
    "lab": Command("Open the chapters and exercises.", forwards_arguments=True, forwards_help=False),
    "check": Command("Check your own solution of an exercise."),
    "submit": Command("Write the files that you hand in, and print what they contain."),
    "sim": Command("Run the robot node alone.", forwards_arguments=True),
    "ros": Command(
        "Run a ros2 command: topic, service, action, node, param, interface.", forwards_arguments=True
    ),
    "collect": Command("Read submissions from a platform's download.", FOR_INSTRUCTORS),
    "grade": Command("Grade a batch of submissions.", FOR_INSTRUCTORS),
    "hour": Command("Show a page with the checks at which students are stuck now.", FOR_INSTRUCTORS),
    "requests": Command(
        "Grade the programs of regrade requests again, and draft the replies.", FOR_INSTRUCTORS
    ),
    "replay": Command("Show a recorded arena: in the web view, as a film, as text."),
    "questions": Command("Make questions for each student about their own program.", FOR_INSTRUCTORS),
    "merge": Command("Merge the parts of a class that were graded separately.", FOR_INSTRUCTORS),
    "export": Command("Write the grades for another platform.", FOR_INSTRUCTORS),
    "package": Command("Make an autograder that another platform runs.", FOR_INSTRUCTORS),
    "gradescope": Command("Grade the upload, inside Gradescope's container.", FOR_INSTRUCTORS),
    "new": Command("Create the folder of a new exercise.", FOR_INSTRUCTORS),
    "release": Command("Write the students' archive.", FOR_INSTRUCTORS),
    "audit": Command("Grade submissions with known faults.", FOR_INSTRUCTORS),
    "book": Command("Make a site for readers of the chapters, exercises and docs.", FOR_INSTRUCTORS),
    "bench": Command("Print the performance table.", FOR_DEVELOPERS),
    "test": Command(
        "Run the tests, all or by tier.", FOR_DEVELOPERS, forwards_arguments=True, forwards_help=False
    ),
}


def is_here(name: str) -> bool:
    """Return whether this copy of the course has the module of a command."""
    try:
        return find_spec(f"{COMMANDS[name].folder}.{name}") is not None
    except ModuleNotFoundError:  # the command's package is missing
        return False


def load(name: str) -> Any:
    """Import a command's module, and return the function or typer.Typer in it that has the command's name."""
    return getattr(import_module(f"{COMMANDS[name].folder}.{name}"), name)


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command in `arguments` (default: the process's arguments), and exit with its status.

    If a script starts a program in the background (`course grade … &`), the program ignores SIGINT, and so do its child
    processes, such as students' nodes. Therefore the default handler of SIGINT is restored first.
    """
    signal.signal(signal.SIGINT, signal.default_int_handler)
    sys.path.append(str(PROJECT / "tests"))  # the commands for developers, and what they use
    if arguments is None:
        _require_utf8()
    arguments = sys.argv[1:] if arguments is None else list(arguments)
    chosen = next((word for word in arguments if not word.startswith("-")), None)
    try:
        if COURSE != PROJECT:
            _keep_work()
        app(chosen)(args=list(arguments), prog_name="course")
    except Exception as error:
        if message := user_message(error):
            sys.exit(message)
        raise


def _keep_work() -> None:
    """Copy the notebooks of a student's copy of the course, or put them back, and print which were put back."""
    from course_cli.kept_work import keep_work

    if os.access(COURSE, os.W_OK):
        for sentence in keep_work():
            print(f"course: {sentence}", file=sys.stderr)


def _require_utf8() -> None:
    """Restart in Python's UTF-8 mode if the locale is not UTF-8, which students' names and texts need."""
    if sys.getfilesystemencoding() != "utf-8" and os.environ.get(UTF8_VARIABLE) != "1":
        os.environ[UTF8_VARIABLE] = "1"
        os.execv(sys.executable, [sys.executable, *sys.orig_argv[1:]])


def _without_type_of_flags(ctx: Any, command: Any) -> Any:
    """Return a command whose help shows no <bool> behind its flags, as they take no value."""
    for option in command.get_params(ctx):
        if getattr(option, "is_bool_flag", False):
            option.metavar = ""
    for each in getattr(command, "commands", {}).values():
        _without_type_of_flags(ctx, each)
    return command


class _Course(TyperGroup):
    """Prints the message of a `CourseError` and exits with its status; the help of flags shows no type."""

    def invoke(self, ctx: Any) -> Any:
        try:
            return super().invoke(ctx)
        except CourseError as error:
            LineConsole().print(str(error), style="red", markup=False)
            raise typer.Exit(error.exit_status) from error

    def get_command(self, ctx: Any, cmd_name: str) -> Any:
        command = super().get_command(ctx, cmd_name)
        return command and _without_type_of_flags(ctx, command)


def app(chosen: str | None) -> typer.Typer:
    """Return the application, which lists every command but has imported only the module of `chosen`."""
    course = typer.Typer(
        cls=_Course, help=HELP, no_args_is_help=True, add_completion=False, pretty_exceptions_enable=False
    )
    for name, command in COMMANDS.items():
        if not is_here(name):
            continue
        target = load(name) if name == chosen else _placeholder(command.summary)
        if isinstance(target, typer.Typer):
            course.add_typer(target, name=name, help=command.summary)
        else:
            course.command(name, context_settings=command.settings)(target)
    # Without a callback, Typer would drop the name of a single command.
    course.callback()(lambda: None)
    return course


def _placeholder(summary: str) -> Callable[[], None]:
    """Return a placeholder that lists a command in the help without importing its module."""

    def listed() -> None: ...

    listed.__doc__ = summary
    return listed
