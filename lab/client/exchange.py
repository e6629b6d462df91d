"""Waiting for a server, and giving up on its answer."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

from lab.client.connection import connection
from lab.client.interaction_log import log
from lab.client.messages import GaveUp
from lab.client.waiting import comes_true
from lab.errors import NoAnswerError, NoServerError
from lab.running.student_nodes import output_of_failed_nodes
from ros_runtime.recorded_client.goal import Cancel, Goal
from ros_runtime.recorded_client.service_client import Call

MATCHING_TIME = 0.1  # s; a server may not have discovered its client yet, and then its answer would be lost


def require_server(is_ready: Callable[[], bool], name: str, interface: Any, timeout: float) -> None:
    """Wait until a server is matched; `name` of the service or action is relative to the namespace.

    Raises NoServerError after `timeout` s; its message names the servers that do exist.
    """
    if is_ready():
        return
    if comes_true(is_ready, timeout):
        time.sleep(MATCHING_TIME)
        return
    here = connection()
    wanted, offered = here.node.resolve_service_name(name), here.servers()
    if wanted in offered:
        seen = f"there is a {wanted}, but of type {offered[wanted]}"
    else:
        seen = f"there are: {', '.join(sorted(offered)) or 'no servers at all'}"
    raise NoServerError(
        f"nobody offers {wanted} ({interface.__name__}) after {timeout:g} s of waiting; {seen}. "
        f"Start a server with lab.run_node('FILE.py').{output_of_failed_nodes()}"
    )


def give_up(asked: Call | Cancel | Goal, timeout: float, what_is_known: str) -> NoAnswerError:
    """Stop waiting, ignore a later answer, and return the error to raise; `timeout`: the caller's limit, s."""
    asked.request.give_up()
    log.append(GaveUp(timeout=timeout))
    return no_answer(what_is_known)


def no_answer(what_is_known: str) -> NoAnswerError:
    """Return the error for a missing answer, with the output of failed nodes."""
    return NoAnswerError(what_is_known + output_of_failed_nodes())
