"""Why a student's program ended by itself, and what to do about it, from its exit status and its last output."""

from __future__ import annotations

import re
import signal
from dataclasses import dataclass

from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.record import Record

GROWS = (
    "Look for a list that grows with every message, request or round of a loop: keep only the last element."
)
LEAKS = "03b_clients_in_bad_company#leak-why"
SERVES_ONE_REQUEST = "02_services#first-intro"
WRONG_TYPE = "02_services#fields-why"
CRASHES = "02_services#m9-why"
OWN_FILE = re.compile(r"/work(?:-[^/]+)?/(\w+\.py)$")  # the folder in which a student's program runs
# The same folder, before the file's name in a traceback.
SANDBOX_FOLDER = re.compile(r'(?<=File ")[^"]*/work(?:-[^/"]+)?/(?=\w+\.py")')
_OF_THE_PROGRAM = re.compile(r"(Attribute|Index|Key|Name|Type|UnboundLocal|Value|ZeroDivision)Error\b")
_NOT_PYTHON = re.compile(r"(IndentationError|SyntaxError|TabError)\b")
_CRASHED = (signal.SIGSEGV, signal.SIGABRT, signal.SIGBUS)


@dataclass(frozen=True)
class Remedy:
    """What to do, and the lesson that shows how; '' stands for the check's lesson."""

    help: str
    see: str = ""


# Remedies by a pattern in the student's traceback, the most specific pattern first; \1 is its first group.
_SIGNS: dict[str, Remedy] = {
    r"in send_response\n(?s:.*)^TypeError$": Remedy(
        "Your service callback{of} returned nothing, or something other than the response. End every branch with "
        "`return response`.",
        "02_services#forget-intro",
    ),
    r"^AssertionError: The 'result' field must be a sub message": Remedy(
        "Your execute callback returned nothing, or something other than a Result: end every branch with "
        "`return result`. A lambda that calls an async function returns a coroutine: give ActionServer the async "
        "function itself.",
        "06_walk_to_a_pose#settle-intro",
    ),
    r"invalid transition from state EXECUTING with event CANCELED": Remedy(
        "goal_handle.canceled() was called while the goal was EXECUTING. A cancel_callback only returns "
        "CancelResponse.ACCEPT; execute calls canceled() when it sees is_cancel_requested.",
        "07_cancel_and_preempt#m12-why",
    ),
    r"^AssertionError: The '(\w+)' field must be a sub message of type '(\w+)'": Remedy(
        r"The field \1 takes a message of the type \2, and got something else: None, if no message has arrived "
        r"yet. Test `is None` first: the task says what \1 is then.",
        CRASHES,
    ),
    r"^AssertionError: The '(\w+)' field must be a set or sequence": Remedy(
        r"The field \1 is a list: give it a list with values of its type, such as [1.0].", WRONG_TYPE
    ),
    r"^AssertionError: The '(\w+)' field must be": Remedy(
        r"The field \1 got a value of the wrong type: give it the type that the interface names, such as 1.0 for a "
        "float and True for a bool, and never None.",
        WRONG_TYPE,
    ),
    r"^TypeError: Expected <class '(?:\w+\.)*(\w+)'>, got <class '(?:\w+\.)*(\w+)'>": Remedy(
        r"publish() takes a message of the type \1, and got a \2: make a message, such as \1(data=…).",
        WRONG_TYPE,
    ),
    r"^AttributeError: '\w+_FeedbackMessage' object has no attribute": Remedy(
        "A feedback callback gets the goal's id and the Feedback in one message: read message.feedback.field.",
        "06_walk_to_a_pose#field-why",
    ),
    # argparse, absl and click; getopt
    r"(?i)(unrecognized|unknown|no such) .*ros-args|ros-args.* not recognized": Remedy(
        "Your program refused --ros-args, with which every ROS program is started. Parse your own arguments only: "
        "`parser.parse_args(rclpy.utilities.remove_ros_args(sys.argv)[1:])`.",
    ),
    r"error: (the following arguments are required|unrecognized arguments|argument \w+: )": Remedy(
        "argparse rejected arguments that the task allows: give an optional argument nargs='?' and a default."
    ),
    r"^AttributeError: '\w+_(Request|Response|Goal|Result|Feedback)' object has no attribute": Remedy(
        "The interface has no field of that name: compare it with `ros2 interface show`.", CRASHES
    ),
    r"^AttributeError: module 'rclpy' has no attribute": Remedy(
        "`import rclpy` does not import its parts: import what you use, as in `from rclpy.node import Node`.",
        "02_services#first-file",
    ),
    r"'NoneType' object has no attribute|'NoneType' object is not": Remedy(
        "A variable is still None, because no message has arrived yet: test `is None` before you use it.",
        CRASHES,
    ),
    r"^RuntimeError: no running event loop": Remedy(
        "rclpy's executor is no asyncio event loop, so asyncio.sleep() fails in a callback. Await a future of "
        "rclpy, or do not wait.",
        "05_executors#m3-why",
    ),
    r"^ValueError: (too many|not enough) values to unpack": Remedy(
        "A value has another number of parts than the names it is unpacked to. Look for a missing comma: "
        '("topic" "a") is one string, and ("topic", "a") are two.',
    ),
    r"No space left on device|File too large": Remedy(
        "It wrote too much to disk: do not write files in a callback or in a loop."
    ),
    r"can't start new thread|Resource temporarily unavailable": Remedy(
        "It started too many threads or processes: start none in a callback or in a loop."
    ),
    r"^OSError: .*Too many open files": Remedy(
        "It opened too many files or nodes: make each once, and close it when you are done."
    ),
    r"^(MemoryError|std::bad_alloc)|Cannot allocate memory": Remedy(
        f"It used too much memory. {GROWS}", LEAKS
    ),
    r"^(IndentationError|SyntaxError|TabError)\b": Remedy(
        "Python cannot read the file. Look in the line named here, and in the one before it, for a missing comma, "
        "bracket, quote or colon, or a wrong indent; then run its cell again.",
        "02_services#first-file",
    ),
    r"^(ImportError|ModuleNotFoundError)\b": Remedy(
        "Python found no module, or no name in it, as the file imports it. If a cell writes that module, run the cell "
        "first; else correct the import, and run its cell again.",
        "02_services#first-file",
    ),
    r"^EOFError: EOF when reading a line": Remedy(
        "input() failed, because nobody types on a node's stdin: remove it, and read settings from parameters.",
        "02_services#first-file",
    ),
}


_LIMITS: dict[str, Remedy] = {  # by a pattern in the reason of a NodeKilled
    r" files\b": Remedy(
        "Look for files that are created in a callback or in a loop: create none, or one at the start."
    ),
    r" sockets\b": Remedy(
        "Look for nodes, clients or connections that are created in a callback or in a loop: create each one once."
    ),
    r"": Remedy(GROWS, LEAKS),
}


def remedy_for_a_limit(killed: ev.NodeKilled) -> Remedy:
    """Return what to do about a program that was ended because it exceeded a limit."""
    return next(remedy for words, remedy in _LIMITS.items() if re.search(words, killed.reason))


def ended_by_itself(run: Record) -> ev.NodeExited | None:
    """Return the end of the student's program if it came before Ctrl-C; None if it did not."""
    exited, signalled = run.first(ev.NodeExited), run.first(ev.NodeSignalled)
    return exited if exited and (signalled is None or exited.t < signalled.t) else None


def is_not_python(run: Record) -> bool:
    """Return whether the program ended because Python could not compile it, so that no other run can differ."""
    exited = ended_by_itself(run)
    # Of an import or of exec() there is a traceback.
    is_the_program = "Traceback (most recent call last)" not in run.output("stderr")
    return bool(exited and exited.returncode and is_the_program and _NOT_PYTHON.match(run.last_words))


def ran_to_its_end(run: Record) -> bool:
    """Return whether the program ended by itself with status 0, or with an exception that no machine causes."""
    exited = ended_by_itself(run)
    return exited is not None and (exited.returncode == 0 or bool(_OF_THE_PROGRAM.match(run.last_words)))


def remedy_for_the_end(run: Record, exited: ev.NodeExited) -> Remedy:
    """Return what to do about a program that ended by itself, or by an exception."""
    service = _unanswered_service(run)
    output = run.output("stderr")
    if exited.returncode and (remedy := remedy_for_a_traceback(output, service)):
        return remedy
    if -exited.returncode in _CRASHED:
        return Remedy(
            f"{signal.Signals(-exited.returncode).name} ended the program, a crash in native code: use no node "
            "or publisher after destroy_node(), nor in two threads at once."
        )
    if exited.returncode > 0 and _gave_up(run):
        return Remedy(
            f"Your program ended on purpose, although the grader offered {_offered(run)}: check its reason, and that "
            "all names are relative and all types those of the task."
        )
    if exited.returncode and run.first(ev.NodeReady) is None:
        return _with_place(Remedy("The exception was raised before your node was ready."), output)
    if exited.returncode:
        return _with_place(
            Remedy("An exception in a callback ends rclpy.spin(), and with it the node.", CRASHES), output
        )
    if _is_a_server(run):
        return Remedy(
            "Use rclpy.spin(node), not spin_once, and do not shut down in a callback: a server runs until Ctrl-C.",
            SERVES_ONE_REQUEST,
        )
    return Remedy("main() returned before everything was done: check what it waits for.")


def remedy_for_a_traceback(output: str, service: str = "") -> Remedy | None:
    """Return what to do about the last exception in a program's output, if it is known; `service` was called."""
    traceback = _last_traceback(output)
    for sign, remedy in _SIGNS.items():
        if found := re.search(sign, traceback, re.MULTILINE):
            help = found.expand(remedy.help).replace("{of}", f" of {service}" if service else "")
            return _with_place(Remedy(help, remedy.see), output)
    return None


def end_in_words(run: Record, exited: ev.NodeExited) -> str:
    """Return how it ended: 'with status 1: TypeError', 'by itself with status 0 after 1 answer'."""
    if exited.returncode:
        said = run.last_words or (run.output("stdout").strip().splitlines() or [""])[-1][:300]
        return f"with status {exited.returncode}" + (f": {said}" if said else "")
    if not _is_a_server(run):
        return "with status 0"
    answers = len(run.all(ev.ServiceAnswered)) + len(run.all(ev.GoalAnswered))
    return f"by itself with status 0 after {answers} answer{'' if answers == 1 else 's'}"


def raised_in(traceback: str) -> str | None:
    """Return the last line of a traceback that is in the student's file, unless that line spins the node."""
    frames = re.findall(r'^\s*File "([^"]+)", line (\d+)(?:, in ([\w.<>]+))?', traceback, re.MULTILINE)
    own = [index for index, (path, *_) in enumerate(frames) if OWN_FILE.search(path)]
    if not own or any(function.startswith("spin") for *_, function in frames[own[-1] + 1 :]):
        return None
    path, line, function = frames[own[-1]]
    where = f", in {function}()" if function.isidentifier() else ""
    return f"line {line} of {path.rsplit('/', 1)[-1]}{where}"


def _with_place(remedy: Remedy, output: str) -> Remedy:
    """Add the student's line that raised the last exception in a program's output, if known."""
    place = raised_in(_last_traceback(output))
    where = f" It was raised in {place}." if place else ""
    return Remedy(remedy.help + where, remedy.see)


def _last_traceback(output: str) -> str:
    """Return the output from its last traceback on: earlier ones did not end the program."""
    return output.rpartition("Traceback (most recent call last):")[2]


def _unanswered_service(run: Record) -> str:
    """Return the service of the first request that got no answer, '' if there is none."""
    answered = {answer.call for answer in run.all(ev.ServiceAnswered)}
    return next((asked.service for asked in run.all(ev.ServiceCalled) if asked.call not in answered), "")


def _gave_up(run: Record) -> bool:
    """Return whether a client ended without an exception, although the grader offered it something."""
    return (
        bool(_offered(run)) and not _is_a_server(run) and "Traceback (most recent" not in run.output("stderr")
    )


def _offered(run: Record) -> str:
    """Return the names of the services and actions that the grader offered: 'get_status and walk_to'."""
    names = [event.service for event in run.all(ev.ServiceOffered)]
    names += [event.action for event in run.all(ev.ActionOffered)]
    names += [event.topic for event in run.all(ev.MessagePublished)]
    return ", ".join(dict.fromkeys(names))


def _is_a_server(run: Record) -> bool:
    """Return whether the student's program is a server, with the grader as its client."""
    return any(run.first(kind) is not None for kind in (ev.ServiceCalled, ev.GoalSent, ev.NodeSignalled))
