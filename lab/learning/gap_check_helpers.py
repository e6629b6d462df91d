"""Helpers of the gap checks: they run a student's code and turn its errors into messages for the student."""

from __future__ import annotations

import re
import runpy
import traceback
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from autograder.authoring.diagnosis.exit_diagnosis import remedy_for_a_traceback
from lab.client.exchange import TIME_TO_END
from lab.client.services import call
from lab.errors import NoAnswerError
from lab.learning.gap import not_yet
from lab.running.node_diagnosis import where_blocked, why_silent
from lab.running.student_nodes import StudentNode

NO_HINTS: Mapping[str, str] = {}


def call_student_service(
    server: StudentNode,
    name: str,
    service_type: type,
    request: Any = None,
    *,
    hints: Mapping[str, str] = NO_HINTS,
) -> Any:
    """Call a service of the student's node and return its response.

    `hints` maps a part of the last line of the node's log to the advice that the student gets if the node has ended.

    Raises GapError when no response arrives; the message says whether the node has ended, and with which error.
    """
    try:
        return call(name, service_type, request)
    except NoAnswerError:
        pass
    ended = server.process.wait(TIME_TO_END)
    reason = last_error_or_line(server.log(), server.file.name)
    advice = advice_on(server.log(), reason, hints) if ended else why_silent(server)
    seen = f"no response within 2 s; the node {f'has ended: {reason}' if ended else 'still runs'}"
    raise not_yet(seen, "a response", advice)


def blocked_or(node: StudentNode, advice: str, meanwhile: str) -> str:
    """Return in which line a callback of a node does not return, and what that prevents; else the `advice`."""
    blocked = where_blocked(node) if node.is_running else ""
    return f"{blocked} {meanwhile}" if blocked else advice


def advice_on(log: str, reason: str, hints: Mapping[str, str] = NO_HINTS) -> str:
    """Return the hint whose key is in the `reason` of a node's end; else what a self-check says about its log."""
    if hint := next((hints[part] for part in hints if part in reason), ""):
        return hint
    remedy = remedy_for_a_traceback(log)
    return remedy.help if remedy else "fix the error that is named here"


def last_error(log: str, file: str) -> str:
    """Return the last exception in a log, with the line of the student's `file` that raised it; "" if there is none."""
    errors = re.findall(r"^[\w.]*(?:Error|Exception)\b.*", log, re.MULTILINE)
    traceback = log.rpartition("Traceback (most recent call last):")[2]
    frames = re.findall(r'File "([^"]+)", line (\d+), in (.+)\n +(.+)', traceback)
    own = [index for index, (path, *_) in enumerate(frames) if Path(path).name == file]
    deeper = frames[own[-1] + 1 :] if own else []
    is_elsewhere = any(frame[2].startswith("spin") or frames[own[-1]][2] == "<module>" for frame in deeper)
    where = " in line {1} (`{3}`)".format(*frames[own[-1]]) if own and not is_elsewhere else ""
    return f"{errors[-1]}{where}" if errors else ""


def last_error_or_line(log: str, file: str) -> str:
    """Return the last exception in a log as `last_error` does, or else its last line."""
    return last_error(log, file) or (log.strip().splitlines() or ["it printed nothing"])[-1]


def read_program(file: str) -> dict[str, Any]:
    """Run a student's file and return the names that it defines, with their values.

    Raises GapError when the file raises an exception.
    """
    return run_student_code(lambda: runpy.run_path(file), file)


def run_student_code(code: Callable[[], Any], file: str, *, hints: Mapping[str, str] = NO_HINTS) -> Any:
    """Call a function that the student wrote in `file`, and return its value.

    `hints` maps a part of an exception's name to the advice that the student gets when it is raised.

    Raises GapError when the function raises an exception; the message quotes the student's line.
    """
    try:
        return code()
    except Exception as problem:
        lines = [f for f in traceback.extract_tb(problem.__traceback__) if Path(f.filename).name == file]
        where = f" in line {lines[-1].lineno} (`{lines[-1].line}`)" if lines else ""
        error = type(problem).__name__
        advice = next((hints[part] for part in hints if part in error), "fix the error that is named here")
        raise not_yet(f"{error}: {problem}{where}", "no exception", advice) from None
