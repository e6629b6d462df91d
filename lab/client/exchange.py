"""What calls and goals share: waiting for a server, and the error when no answer arrives."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

from lab.client.connection import connection
from lab.client.interaction_log import log
from lab.client.messages import GaveUp
from lab.client.waiting import becomes_true
from lab.errors import NoAnswerError, NoServerError
from lab.running.student_nodes import output_of_failed_nodes
from ros_runtime.recorded_client.goal import Cancel, Goal
from ros_runtime.recorded_client.service_client import Call

MATCHING_TIME = 0.1  # s until the server has discovered the client, too; otherwise its answer could be lost


def require_server(is_ready: Callable[[], bool], name: str, interface: Any, timeout: float) -> None:
    """Wait until a server is matched; the `name` of its service or action is relative to the namespace.

    Raises NoServerError after `timeout` s; the message lists the servers that exist.
    """
    if is_ready():
        return
    if becomes_true(is_ready, timeout):
        time.sleep(MATCHING_TIME)
        return
    here = connection()
    wanted, offered = here.node.resolve_service_name(name), here.servers()
    if wanted in offered:
        seen = f"there is a {wanted}, but of type {offered[wanted]}"
    else:
        seen = f"the nodes offer: {', '.join(sorted(offered)) or 'nothing'}"
    raise NoServerError(
        f"no node offers {wanted} ({interface.__name__}) within {timeout:g} s; {seen}. "
        f"Start a server with lab.run_node('FILE.py').{output_of_failed_nodes()}"
    )


def give_up(sent: Call | Cancel | Goal, timeout: float, what_is_known: str) -> NoAnswerError:
    """Stop waiting for an answer and return the error to raise; an answer that arrives later is ignored.

    `timeout` is how long the caller has waited, in s.
    """
    sent.request.give_up()
    log.append(GaveUp(timeout=timeout))
    return no_answer(what_is_known)


def no_answer(what_is_known: str) -> NoAnswerError:
    """Return the error for a missing answer, with the output of failed nodes."""
    return NoAnswerError(what_is_known + output_of_failed_nodes())
