"""Functions that the checks of several gaps share."""

from __future__ import annotations

import re
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
HINTS = {"TypeError": "end each path of the callback with `return response`"}  # rclpy's message says no more
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
    reason = last_words(server.log(), server.file.name)
    if ended:
        known = {**hints, **HINTS}
        advice = next((known[part] for part in known if part in reason), "mend what this error names")
    else:
        advice = "look for what keeps the callback from returning"
    seen = f"no response within 2 s; the node {f'has ended: {reason}' if ended else 'still runs'}"
    raise not_yet(seen, "a response", advice)


def last_error(log: str, file: str) -> str:
    """Return the last exception in a log, with the line of the student's `file` that raised it; "" if there is none."""
    errors = re.findall(r"^[\w.]*(?:Error|Exception)\b.*", log, re.MULTILINE)
    frame = rf'File "(?:[^"]*/)?{re.escape(file)}", line \d+, in (?!<module>).*\n +(.+)'
    lines = re.findall(frame, log.rpartition("Traceback (most recent call last):")[2])
    where = f" in `{lines[-1]}`" if lines else ""
    return f"{errors[-1]}{where}" if errors else ""


def last_words(log: str, file: str) -> str:
    """Return the last exception in a log as `last_error` does, or else its last line."""
    return last_error(log, file) or (log.strip().splitlines() or ["it printed nothing"])[-1]


def read_program(file: str) -> dict[str, Any]:
    """Run a student's file and return what it defines.

    Raises GapError when that raises.
    """
    return asked(lambda: runpy.run_path(file), file)


def asked(call: Callable[[], Any], file: str, *, hints: Mapping[str, str] = NO_HINTS) -> Any:
    """Call what the student wrote in `file` and return what it returns.

    `hints` are what to do next when it raises, by a part of the error's name.

    Raises GapError when that raises; it quotes the student's line.
    """
    try:
        return call()
    except Exception as problem:
        lines = [f for f in traceback.extract_tb(problem.__traceback__) if Path(f.filename).name == file]
        where = f" in `{lines[-1].line}`" if lines else ""
        error = type(problem).__name__
        advice = next((hints[part] for part in hints if part in error), "mend what this error names")
        raise not_yet(f"{error}: {problem}{where}", "no exception", advice) from None
