"""Why a student's node gives no answer, in the words of the self-check: from its output, its end and its stacks."""

from __future__ import annotations

import ast
import math
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from autograder.authoring.diagnosis.blocked_callback import remedy_for_no_answer
from autograder.authoring.diagnosis.connections import why_no_command_arrives, why_no_message_arrives
from autograder.authoring.diagnosis.exit_diagnosis import (
    remedy_for_a_traceback,
    remedy_for_the_end,
)
from autograder.authoring.diagnosis.goal_diagnosis import why_no_result, why_rclpy_aborted
from autograder.authoring.diagnosis.missing_comma import with_comma
from autograder.authoring.diagnosis.readiness import require_ready
from autograder.authoring.diagnosis.service_callback import syntax_tree, with_callback
from autograder.authoring.diagnosis.stack_location import where_it_waited, with_code
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.failure import Failure
from autograder.engine.starter import what_is_to_be_written
from autograder.engine.submission import Submission
from lab.client.connection import NAMESPACE, ROBOT_NODE, connection
from lab.client.graph import Endpoint, Topic, topics_in_graph
from lab.client.interaction_log import log
from lab.tracebacks import OF_OTHERS
from ros_runtime.record.event import Event

if TYPE_CHECKING:
    from lab.running.student_nodes import StudentNode

_SEEN_BY_THE_CLIENT = (
    *(ev.ServiceCalled, ev.ServiceAnswered, ev.Unanswered),
    *(ev.GoalSent, ev.GoalAnswered, ev.FeedbackReceived, ev.StatusSeen, ev.ResultReceived),
)
_SAMPLES = 3  # of the stacks; a callback that is in all of them does not return
_FRAME = re.compile(r'^  File "([^"]+)", line \d+.*\n(?:    .*\n)*', re.MULTILINE)
_FOLDER = re.compile(r'(?<=File ")[^"]*/(?=\w+\.py")')
_ERROR = re.compile(r"^[\w.]*(?:Error|Exception)\b.*", re.MULTILINE)


def why_they_ended(nodes: Iterable[StudentNode]) -> str:
    """Return why nodes ended with an error, each in a line; "" if none did."""
    return "".join(
        f"\n{node.file.name} has ended {how_it_ended(node)}" for node in nodes if _has_failed(node)
    )


def what_is_missing(programs: Iterable[Path]) -> str:
    """Return which `# YOUR CODE HERE` in programs have no code below them yet, a line for each program; "" if none."""
    found = [what_is_to_be_written(*_program(file)) for file in programs]
    return "".join(f"\n{sentence}" for sentence in found if sentence)


def all_have_failed(nodes: Iterable[StudentNode]) -> bool:
    """Whether none of the nodes runs any more, except those that were stopped, and one has ended with an error."""
    kept = [node for node in nodes if not node.was_stopped]
    return any(map(_has_failed, kept)) and not any(node.is_running for node in kept)


def why_not_connected(nodes: Iterable[StudentNode]) -> str:
    """Return why running nodes and the robot do not receive each other's messages, each cause in a line; "" if none.

    A node needs those of the robot's topics whose type its file imports, or whose name it uses in another namespace.
    """
    found = [(node.file.name, why) for node in nodes if node.is_running for why in _missing_connections(node)]
    return "".join(f"\n{name}: {why}" for name, why in found)


def where_blocked(node: StudentNode) -> str:
    """Return in which line a callback of a running node does not return, and what follows; "" if none is blocked."""
    help = ""
    for _ in range(_SAMPLES):
        run = _record(node, _stack(node))
        if not where_it_waited(run):
            return ""
        help = _why_no_answer(run, node)
    return help


def how_it_ended(node: StudentNode) -> str:
    """Return the exit status of a node that ended with an error, the error, and what to do."""
    run = _record(node)
    help = remedy_for_the_end(run, ev.NodeExited(returncode=node.exit_status or 0)).help
    help = with_callback(help, {node.file.name: _text(node.file)})
    words = run.last_words.rstrip(".?")
    return f"with exit status {node.exit_status}: {words}. {with_code_of(node.file, help)}"


def own_output(node: StudentNode) -> str:
    """Return what a node printed, without its folder and without the lines of tracebacks that are in libraries."""
    own = _FRAME.sub(lambda frame: "" if frame[1].startswith(OF_OTHERS) else frame[0], node.log())
    return own.replace(f"{node.file.parent}/", "")


def why_not_offered(node: StudentNode, name: str, *, is_action: bool) -> str:
    """Return what a node offers instead of a service or action with this full name, or how it ended."""
    offered = [f"{service} [{type}]" for service, type in _offered_by(node).items()]
    missing = [f"{name}/_action/send_goal" if is_action else name]
    try:
        require_ready(_record(node, ev.NodeNotReady(missing=missing, offered=offered, waited=0.0)))
    except Failure as failure:
        return f"\n{node.file.name}: {failure.observed}. {with_code_of(node.file, failure.help)}"
    return ""


def why_silent(server: StudentNode) -> str:
    """Return why a running server does not answer: a blocked thread, or an exception that has not ended it."""
    run = _record(server, _stack(server))
    if "Traceback (most recent call last)" in server.log() and not where_it_waited(run):
        remedy = remedy_for_a_traceback(server.log())
        errors = _ERROR.findall(server.log()) or ["an exception"]
        help = f" {remedy.help}" if remedy else ""
        return f"{server.file.name} still runs, but has printed {errors[-1]}.{help}"
    return _why_no_answer(run, server)


def why_unfinished(server: StudentNode, goal: str) -> str:
    """Return why a goal that a running server has accepted has no result yet; "" if it is not in the log any more."""
    sent = log.first(ev.GoalSent, goal=goal)
    if not sent:
        return ""
    return with_code_of(server.file, why_no_result(_record(server, _stack(server)).goal(goal))[1])


def why_aborted(nodes: Iterable[StudentNode], action: str, goal: str) -> str:
    """Return why rclpy aborted a goal by itself; "" if it did not, or if that is not known."""
    server = server_of(nodes, action) if log.first(ev.GoalSent, goal=goal) else None
    return with_code_of(server.file, why_rclpy_aborted(_record(server).goal(goal)) or "") if server else ""


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


def _program(file: Path) -> tuple[Submission, Path]:
    """Return a node's program, and the notebook beside it that may have written it."""
    return Submission(file.stem, "", {file.name: _text(file)}), file.with_suffix(".ipynb")


def _missing_connections(node: StudentNode) -> Iterator[str]:
    """Yield what keeps a node and the robot from receiving each other's messages."""
    topics = [topic for topic in topics_in_graph() if "/_action/" not in topic.name]
    publishers = [(topic.name, topic.publishers) for topic in topics]
    subscriptions = [(topic.name, topic.subscriptions) for topic in topics]
    own, robot = set(node.names), {ROBOT_NODE}
    published, subscribed = _types(publishers, own), _types(subscriptions, own)
    from_robot, to_robot = _types(publishers, robot), _types(subscriptions, robot)
    seen = ev.NodeTopics(t=0.0, publishes=[*published], subscribes=[*subscribed])
    peers = ev.RobotPeers(
        t=0.0,
        subscribers={
            topic.name: _count_matches(topic, robot, own) for topic in topics if topic.name in from_robot
        },
        publishers={
            topic.name: _count_matches(topic, own, robot) for topic in topics if topic.name in to_robot
        },
    )
    run = Transcript.from_events("", {}, [seen, peers])
    imported = _imported_messages(node.file)
    for topic in _needed(from_robot, subscribed, imported):
        if why := why_no_message_arrives(run, topic):
            yield why
    for topic in _needed(to_robot, published, imported):
        if why := why_no_command_arrives(run, topic, before=math.inf):
            yield f"On {topic} the robot sees {why}."


def _needed(of_robot: Mapping[str, str], of_node: Iterable[str], imported: set[str]) -> list[str]:
    """Return the robot's topics, without the namespace, that a node needs by its imports or by the names it uses.

    `of_robot` has the types of the topics at the robot, by full name.
    """
    names = {name.rpartition("/")[2] for name in of_node}
    by_type = Counter(of_robot.values())
    relative = {name.removeprefix(f"{NAMESPACE}/"): type for name, type in of_robot.items()}
    return [
        name
        for name, type in relative.items()
        if "/" not in name and (name in names or (type in imported and by_type[type] == 1))
    ]


def _types(ends: Iterable[tuple[str, Iterable[Endpoint]]], nodes: set[str]) -> dict[str, str]:
    """Return the type of each topic, by full name, on which one of these nodes publishes or subscribes."""
    return {name: end.type for name, each in ends for end in each if end.node in nodes}


def _count_matches(topic: Topic, senders: set[str], receivers: set[str]) -> int:
    """Return how many subscriptions of some nodes receive what other nodes publish on a topic."""
    publishers = [end for end in topic.publishers if end.node in senders]
    return sum(
        any(end.type == other.type and other not in topic.incompatible_with(end) for other in publishers)
        for end in topic.subscriptions
        if end.node in receivers
    )


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
    return line if any(f'"{folder}' in line for folder in OF_OTHERS) else _FOLDER.sub("/work/", line)


def _imported_messages(file: Path) -> set[str]:
    """Return the message types that a file imports, such as "sensor_msgs/msg/BatteryState"."""
    return {
        f"{each.module.removesuffix('.msg')}/msg/{name.name}"
        for each in ast.walk(syntax_tree(_text(file)))
        if isinstance(each, ast.ImportFrom) and each.module and each.module.endswith(".msg")
        for name in each.names
    }


def _why_no_answer(run: Transcript, node: StudentNode) -> str:
    """Return why a node gives no answer; where it was blocked, also the innermost `while` loop around that line."""
    help, place = remedy_for_no_answer(run).help, where_it_waited(run)
    if place:
        nodes = ast.walk(syntax_tree(_text(node.file.with_name(place.file))))
        loops = [each for each in nodes if isinstance(each, ast.While)]
        around = [each.lineno for each in loops if each.lineno < place.line <= (each.end_lineno or 0)]
        if around:
            help = help.replace(str(place), f"{place}, in the loop of line {max(around)} of {place.file}")
    return with_code_of(node.file, help)


def _text(file: Path) -> str:
    """Return the text of a node's file; "" if it has been removed."""
    return file.read_text(encoding="utf-8", errors="replace") if file.is_file() else ""


def with_code_of(file: Path, advice: str) -> str:
    """Return advice that quotes the line that it names of the student's file, or of one beside it."""
    advice = with_comma(advice, {file.name: _text(file)})
    return with_code(advice, {each.name: _text(each) for each in file.parent.glob("*.py")})
