"""One request to a server and its answer."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

from lab import story
from lab.connection import connection
from lab.errors import NoServerError
from lab.student_nodes import last_words
from lab.waiting import comes_true, is_done_within
from lab.wording import describe_briefly

MATCHING_TIME = (
    0.1  # s; a server that has just been found may not have found its client, and its answer would be lost
)


class Exchange:
    """Sends a request at once, and writes it and its answer into the story.

    Args:
        client: of rclpy.
        request: the message to send.
        server: who is asked, for the story.
        label: what for, for the story.
        in_words: the answer for the story.
        on_answer: is called with the answer, on the spinning thread.
        continues: it belongs to the goal before it, not to a story of its own.
    """

    def __init__(
        self,
        client: Any,
        request: Any,
        server: str,
        label: str,
        *,
        in_words: Callable[[Any], str] = describe_briefly,
        on_answer: Callable[[Any], None] | None = None,
        continues: bool = False,
    ) -> None:
        self._client, self._server = client, server
        self._in_words, self._on_answer = in_words, on_answer
        story.begin(self, continues=continues)
        story.tell(story.NOTEBOOK, server, label, "request")
        self._future = client.call_async(request)
        self._future.add_done_callback(self._note)

    @property
    def answer(self) -> Any:
        """The answer, or None as long as there is none."""
        return self._future.result() if self._future.done() else None

    def wait(self, timeout: float) -> bool:
        """Whether the answer is there or comes within `timeout` s."""
        return is_done_within(self._future, timeout)

    def give_up(self, timeout: float) -> None:
        """Wait no longer; an answer that comes later is ignored. `timeout` (s) is for the story."""
        self._client.remove_pending_request(self._future)  # or it is kept for as long as the kernel lives
        story.tell(story.NOTEBOOK, story.NOTEBOOK, f"no answer after {timeout:g} s")
        story.end(self)

    def _note(self, future: Any) -> None:
        story.tell(self._server, story.NOTEBOOK, self._in_words(future.result()), "answer")
        if self._on_answer:
            self._on_answer(future.result())
        story.end(self)


def require_server(is_ready: Callable[[], bool], name: str, interface: Any, timeout: float) -> None:
    """Wait until a server is matched. `name` is relative; for an action it is the action's.

    Raises NoServerError, saying what is offered instead, after `timeout` s.
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
        f"Start a server with lab.run_node('FILE.py').{last_words()}"
    )
