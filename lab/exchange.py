"""One request to a server and its answer."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

from lab import interaction_log
from lab.connection import connection
from lab.errors import NoServerError
from lab.formatting import describe_briefly
from lab.student_nodes import output_of_failed_nodes
from lab.waiting import comes_true, is_done_within

MATCHING_TIME = (
    0.1  # s; a server that has just been found may not have found its client, and its answer would be lost
)


class Exchange:
    """A request that is sent at once; it and its answer are recorded in the interaction log.

    Args:
        client: of rclpy.
        request: the message to send.
        server: name of the server in the log.
        label: text of the request in the log.
        format_answer: makes the text of the answer in the log.
        on_answer: is called with the answer, on the spinning thread.
        continues: it belongs to the goal before it and starts no new log.
    """

    def __init__(
        self,
        client: Any,
        request: Any,
        server: str,
        label: str,
        *,
        format_answer: Callable[[Any], str] = describe_briefly,
        on_answer: Callable[[Any], None] | None = None,
        continues: bool = False,
    ) -> None:
        self._client, self._server = client, server
        self._format_answer, self._on_answer = format_answer, on_answer
        interaction_log.begin(self, continues=continues)
        interaction_log.record(interaction_log.NOTEBOOK, server, label, "request")
        self._future = client.call_async(request)
        self._future.add_done_callback(self._note)

    @property
    def answer(self) -> Any:
        """The answer, or None as long as there is none."""
        return self._future.result() if self._future.done() else None

    def wait(self, timeout: float) -> bool:
        """Wait for the answer; return whether it arrived within `timeout` s."""
        return is_done_within(self._future, timeout)

    def give_up(self, timeout: float) -> None:
        """Stop waiting; a later answer is ignored. `timeout` (s) is how long the caller has waited, for the log."""
        self._client.remove_pending_request(self._future)  # or it is kept for as long as the kernel lives
        interaction_log.record(
            interaction_log.NOTEBOOK, interaction_log.NOTEBOOK, f"no answer after {timeout:g} s"
        )
        interaction_log.end(self)

    def _note(self, future: Any) -> None:
        interaction_log.record(
            self._server, interaction_log.NOTEBOOK, self._format_answer(future.result()), "answer"
        )
        if self._on_answer:
            self._on_answer(future.result())
        interaction_log.end(self)


def require_server(is_ready: Callable[[], bool], name: str, interface: Any, timeout: float) -> None:
    """Wait until a server is matched. `name` is that of the service or action, relative to the namespace.

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
