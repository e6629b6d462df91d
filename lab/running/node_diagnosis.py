"""Why a student's node gives no answer, in the words of the self-check: from its output, its end and its stacks."""

from __future__ import annotations

import ast
import re
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

from autograder.authoring.diagnosis.blocked_callback import remedy_for_no_answer
from autograder.authoring.diagnosis.exit_diagnosis import (
    remedy_for_a_traceback,
    remedy_for_the_end,
    unanswered_service,
)
from autograder.authoring.diagnosis.goal_diagnosis import why_no_result, why_rclpy_aborted
from autograder.authoring.diagnosis.readiness import require_ready
from autograder.authoring.diagnosis.stack_location import where_it_waited
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.failure import Failure
from lab.client.connection import NAMESPACE, connection
from lab.client.interaction_log import log
from ros_runtime.project import PROJECT
from ros_runtime.record.event import Event

if TYPE_CHECKING:
    from lab.running.student_nodes import StudentNode

_SEEN_BY_THE_CLIENT = (
    *(ev.ServiceCalled, ev.ServiceAnswered, ev.Unanswered),
    *(ev.GoalSent, ev.GoalAnswered, ev.FeedbackReceived, ev.StatusSeen, ev.ResultReceived),
)
_OF_OTHERS = (
    sys.prefix,
    sys.base_prefix,
    str(PROJECT / "ros_runtime"),
    "<frozen",
)  # folders of code in tracebacks
_FRAME = re.compile(r'^  File "([^"]+)", line \d+.*\n(?:    .*\n)*', re.MULTILINE)
_FOLDER = re.compile(r'(?<=File ")[^"]*/(?=\w+\.py")')
_PLACE = re.compile(r"line (\d+) of (\w+\.py)")
_ERROR = re.compile(r"^[\w.]*(?:Error|Exception)\b.*", re.MULTILINE)
_EMPTY_PLACE = re.compile(
    r"^(?P<indent> *)# YOUR CODE HERE.*\n(?: *(?:#.*)?\n)*(?! *(?:#|\n))(?:(?P=indent)return \w+$|(?!(?P=indent)))",
    re.MULTILINE,
)


def why_they_ended(nodes: Iterable[StudentNode]) -> str:
    """Return why nodes ended with an error, each in a line; "" if none did."""
    return "".join(
        f"\n{node.file.name} has ended {how_it_ended(node)}" for node in nodes if _has_failed(node)
    )


def what_is_to_be_written(nodes: Iterable[StudentNode]) -> str:
    """Return where nothing is written yet below `# YOUR CODE HERE` in running nodes, each in a line; "" if nowhere."""
    places = ((node.file.name, _empty_places(node.file)) for node in nodes if node.is_running)
    return "".join(
        f"\n{name} is as the starter leaves it below `# YOUR CODE HERE` in line {' and '.join(lines)}: "
        "write your code there."
        for name, lines in places
        if lines
    )


def how_it_ended(node: StudentNode) -> str:
    """Return the exit status of a node that ended with an error, the error, and what to do."""
    run = _record(node)
    help = remedy_for_the_end(run, ev.NodeExited(returncode=node.exit_status or 0)).help
    if "service callback of" in help:
        help += _on_the_callback(unanswered_service(run), node.file)
    return f"with exit status {node.exit_status}: {run.last_words}. {_with_code(help, node)}"


def own_output(node: StudentNode) -> str:
    """Return what a node printed, without its folder and without the lines of tracebacks that are in libraries."""
    own = _FRAME.sub(lambda frame: "" if frame[1].startswith(_OF_OTHERS) else frame[0], node.log())
    return own.replace(f"{node.file.parent}/", "")


def why_not_offered(node: StudentNode, name: str, *, is_action: bool) -> str:
    """Return what a node offers instead of a service or action with this full name, or how it ended."""
    offered = [f"{service} [{type}]" for service, type in _offered_by(node).items()]
    missing = [f"{name}/_action/send_goal" if is_action else name]
    try:
        require_ready(_record(node, ev.NodeNotReady(missing=missing, offered=offered, waited=0.0)))
    except Failure as failure:
        return f"\n{node.file.name}: {failure.observed}. {_with_code(failure.help, node)}"
    return ""


def why_silent(server: StudentNode) -> str:
    """Return why a running server does not answer: a blocked thread, or an exception that has not ended it."""
    run = _record(server, _stack(server))
    if "Traceback (most recent call last)" in server.log() and not where_it_waited(run):
        remedy = remedy_for_a_traceback(server.log())
        errors = _ERROR.findall(server.log()) or ["an exception"]
        help = f" {remedy.help}" if remedy else ""
        return f"{server.file.name} still runs, but has printed {errors[-1]}.{help}"
    return _with_code(remedy_for_no_answer(run).help, server)


def why_unfinished(server: StudentNode, goal: str) -> str:
    """Return why a goal that a running server has accepted has no result yet; "" if it is not in the log any more."""
    sent = log.first(ev.GoalSent, goal=goal)
    return _with_code(why_no_result(_record(server, _stack(server)).goal(goal))[1], server) if sent else ""


def why_aborted(nodes: Iterable[StudentNode], action: str, goal: str) -> str:
    """Return why rclpy aborted a goal by itself; "" if it did not, or if that is not known."""
    server = server_of(nodes, action) if log.first(ev.GoalSent, goal=goal) else None
    return _with_code(why_rclpy_aborted(_record(server).goal(goal)) or "", server) if server else ""


def server_of(nodes: Iterable[StudentNode], name: str) -> StudentNode | None:
    """Return the running node that offers a service or action; None if it has ended.

    If no node is known to offer it, the only one that runs does, unless another has ended with an error.
    """
    wanted = connection().node.resolve_service_name(name)
    nodes = list(nodes)
    running = [node for node in nodes if node.is_running]
    offering = [node for node in running if wanted in _offered_by(node)]
    if not offering and not any(map(_has_failed, nodes)):
        offering = running
    return offering[0] if len(offering) == 1 else None


def _has_failed(node: StudentNode) -> bool:
    return bool(node.exit_status) and not node.was_stopped


def _empty_places(file: Path) -> list[str]:
    """Return the numbers of the lines `# YOUR CODE HERE` that no line of the student follows."""
    program = file.read_text(encoding="utf-8", errors="replace") if file.is_file() else ""
    return [str(program.count("\n", 0, place.start()) + 1) for place in _EMPTY_PLACE.finditer(program)]


def _offered_by(node: StudentNode) -> dict[str, str]:
    """Return the types of a node's services and actions, by full name."""
    found: dict[str, str] = {}
    for full_name in node.names:
        namespace, _, name = full_name.rpartition("/")
        found |= connection().servers_of(name, namespace or "/")
    return found


def _record(node: StudentNode, *more: Event) -> Transcript:
    """Return what is known of a node and of the notebook's last requests, as an arena would record it."""
    began, ended = node.process.began, node.process.ended()
    printed = [
        ev.NodeOutput(t=at, stream="stderr", text=_as_in_the_sandbox(line.rstrip("\n")))
        for at, line in node.process.lines()
    ]
    seen = [event for kind in _SEEN_BY_THE_CLIENT for event in log.all(kind)]
    ready = [ev.NodeReady(t=began, waited=0.0)] if node.names else []
    exited = [] if ended is None else [ev.NodeExited(t=ended, returncode=node.exit_status or 0)]
    # The names in it have the robot's namespace.
    peers = ev.RobotPeers(t=began, subscribers={f"{NAMESPACE}/cmd_vel": 0}, publishers={})
    started = ev.NodeStarted(t=began)
    return Transcript.from_events("", {}, [started, *ready, peers, *printed, *seen, *exited, *more])


def _stack(node: StudentNode) -> ev.NodeStack:
    return ev.NodeStack(lines=[_as_in_the_sandbox(line) for line in node.process.stacks()])


def _as_in_the_sandbox(line: str) -> str:
    """Return a line of a traceback with a file of the student in the folder /work, where the diagnosis expects it."""
    return line if any(f'"{folder}' in line for folder in _OF_OTHERS) else _FOLDER.sub("/work/", line)


def _on_the_callback(service: str, file: Path) -> str:
    """Return which function of a file is the callback of a service, and whether it returns a value; "" if unknown."""
    try:
        tree = ast.parse(file.read_bytes())
    except (OSError, SyntaxError):  # it was changed since the program was started
        return ""
    functions = {
        each.name: each for each in ast.walk(tree) if isinstance(each, ast.FunctionDef | ast.AsyncFunctionDef)
    }
    for call in ast.walk(tree):
        if isinstance(call, ast.Call) and ast.unparse(call.func).endswith("create_service"):
            names = [ast.unparse(argument).rpartition(".")[2] for argument in call.args]
            if repr(service) in names and (callback := functions.get(names[-1])):
                returns = any(isinstance(each, ast.Return) and each.value for each in ast.walk(callback))
                so = "" if returns else ", which returns no value, that is None"
                return f" The callback is {callback.name}() in line {callback.lineno} of {file.name}{so}."
    return ""


def _with_code(advice: str, node: StudentNode) -> str:
    """Return advice that quotes the line of the student's file that it names."""

    def quoted(place: re.Match[str]) -> str:
        file = node.file.with_name(place[2])
        lines = file.read_text(encoding="utf-8", errors="replace").splitlines() if file.is_file() else []
        line = lines[int(place[1]) - 1].strip() if int(place[1]) <= len(lines) else ""
        return f"{place[0]} (`{line}`)" if line else place[0]

    return _PLACE.sub(quoted, advice)
