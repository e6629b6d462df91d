"""Waits for servers and for conditions, and the errors when they do not come, or when no answer arrives."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from typing import Any

from lab.client import topics
from lab.client.connection import connection
from lab.client.interaction_log import log
from lab.client.messages import GaveUp
from lab.client.waiting import becomes_true
from lab.errors import NoAnswerError, NoServerError, NotInTimeError
from lab.running.node_diagnosis import (
    all_have_failed,
    server_of,
    what_is_missing,
    why_not_connected,
    why_not_offered,
    why_silent,
    why_they_ended,
)
from lab.running.student_nodes import StudentNode, started_nodes
from ros_runtime.cell_notice import notice
from ros_runtime.recorded_client.goal import Cancel, Goal
from ros_runtime.recorded_client.service_client import Call

TIME_TO_END = 1.0  # s; long enough for a node to end after an exception
LIES = "The robot lies on the floor. lab.restart_robot() sets it up, if this waits for a robot that stands."
MATCHING_TIME = 0.1  # s until the server has discovered the client, too; otherwise its answer could be lost


def wait_until(
    condition: Callable[[], Any],
    timeout: float = 10.0,
    what: str = "the condition",
    seen: Callable[[], Any] | None = None,
) -> None:
    """Block until `condition()` is true; `what` names the condition in the error, which shows `seen()` instead.

    A notice says what is awaited, and whether the robot lies, or is gone, at the beginning. Raises NotInTimeError after
    `timeout` s; it also says if the robot lies, or is gone, why nodes have ended, what is still to be written in one
    that runs, and why it receives no messages.
    """
    began = time.monotonic()
    taken = topics.taken_robot()
    remark = f" {LIES}" if topics.fell_at() else f" But {taken}." if taken else ""
    with notice(f"This waits up to {timeout:g} s for: {what}.{remark}"):
        if becomes_true(condition, timeout):
            return
    message = f"{what}: not within {timeout:g} s" + (f", but {seen() or 'an empty text'!r}" if seen else "")
    if fell := topics.fell_at():
        when = f"{abs(fell - began):.1f} s {'after' if fell > began else 'before'} this wait began"
        message += f". The robot lies: it fell {when}. lab.restart_robot() sets it up again."
    if taken:
        message += f"; {taken}"
    nodes = started_nodes()
    running = [node.file for node in nodes if node.is_running]
    raise NotInTimeError(
        message + (why_they_ended(nodes) or what_is_missing(running) or why_not_connected(nodes))
    )


def require_server(is_ready: Callable[[], bool], name: str, interface: Any, timeout: float) -> None:
    """Wait until a server is matched; the `name` of its service or action is relative to the namespace.

    Raises NoServerError after `timeout` s; the message lists the servers that exist.
    """
    if is_ready():
        return
    here, began = connection(), time.monotonic()

    def is_over() -> bool:
        return is_ready() or (time.monotonic() > began + TIME_TO_END and all_have_failed(started_nodes()))

    with notice(f"This waits up to {timeout:g} s for a node that offers {name}."):
        becomes_true(is_over, timeout)
    if is_ready():
        time.sleep(MATCHING_TIME)
        return
    timeout = min(timeout, math.ceil(time.monotonic() - began))
    wanted, offered = here.node.resolve_service_name(name), here.servers()
    if wanted in offered:
        seen = f"there is a {wanted}, but of type {offered[wanted]}"
    else:
        seen = f"the nodes offer: {', '.join(sorted(offered)) or 'nothing'}"
    why = "Start a server with lab.run_node('FILE.py')."
    if nodes := [node for node in started_nodes() if not node.was_stopped]:
        why = why_not_offered(nodes[-1], wanted, is_action=hasattr(interface, "Goal"))
    raise NoServerError(f"no node offers {wanted} ({interface.__name__}) within {timeout:g} s; {seen}. {why}")


def give_up(sent: Call | Cancel | Goal, timeout: float, name: str, what_is_known: str) -> NoAnswerError:
    """Stop waiting for an answer and return the error to raise; an answer that arrives later is ignored.

    `timeout` is how long the caller has waited, in s; `name` is the service or action.
    """
    sent.request.give_up()
    log.append(GaveUp(timeout=timeout))
    return no_answer(name, what_is_known)


def no_answer(name: str, what_is_known: str, why: Callable[[StudentNode], str] = why_silent) -> NoAnswerError:
    """Return the error for a missing answer: `why` the server of `name` gives none, and why other nodes have ended."""
    nodes = started_nodes()
    server = server_of(nodes, name)
    if server and server.process.wait(TIME_TO_END):
        server = None  # the reason is in why_they_ended
    return NoAnswerError(what_is_known + (f"\n{why(server)}" if server else "") + why_they_ended(nodes))
