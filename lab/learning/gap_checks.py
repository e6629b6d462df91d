"""Functions that the checks of several gaps share."""

from __future__ import annotations

import runpy
import traceback
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from lab.client.services import call
from lab.client.waiting import comes_true
from lab.errors import NoAnswerError
from lab.learning.gap import not_yet
from lab.running.student_nodes import StudentNode

TO_END = 1.0  # s; long enough for a node to exit after an exception
HINTS = {
    "TypeError": "end each path of the callback with `return response`"
}  # rclpy's error message gives no more information
NO_HINTS: Mapping[str, str] = {}


def ask(
    server: StudentNode,
    name: str,
    service_type: type,
    request: Any = None,
    *,
    hints: Mapping[str, str] = NO_HINTS,
) -> Any:
    """Call a service of the student's node and return its response.

    `hints`: the next step if the node has ended, by a part of the last line of its log.

    Raises GapError when no response arrives; it says whether the node has ended, and with which error.
    """
    try:
        return call(name, service_type, request)
    except NoAnswerError:
        pass
    ended = comes_true(lambda: not server.is_running, TO_END)
    reason = (server.log().strip().splitlines() or ["it printed nothing"])[-1]
    if ended:
        known = {**hints, **HINTS}
        advice = next((known[part] for part in known if part in reason), "mend what this error names")
    else:
        advice = "look for what keeps the callback from returning"
    seen = f"no response within 2 s; the node {f'has ended: {reason}' if ended else 'still runs'}"
    raise not_yet(seen, "a response", advice)


def read_program(file: str) -> dict[str, Any]:
    """Run a student's file and return what it defines.

    Raises GapError when that raises.
    """
    return asked(lambda: runpy.run_path(file), file)


def asked(call: Callable[[], Any], file: str) -> Any:
    """Call what the student wrote in `file` and return what it returns.

    Raises GapError when that raises; it quotes the student's line.
    """
    try:
        return call()
    except Exception as problem:
        lines = [f for f in traceback.extract_tb(problem.__traceback__) if Path(f.filename).name == file]
        where = f" in line {lines[-1].lineno}: {lines[-1].line}" if lines else ""
        raise not_yet(
            f"{type(problem).__name__}: {problem}{where}", "no exception", "mend what this error names"
        ) from None
