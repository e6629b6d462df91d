"""The line of the student's file in which a program was blocked, from the stacks that Python printed at its end."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

from autograder.authoring.diagnosis.exit_diagnosis import OWN_FILE
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.record import Record

_FRAME = re.compile(r'File "([^"]+)", line (\d+) in ([\w.<>]+)')
_PLACE = re.compile(r"line (\d+) of (\w+\.py)")
_SPINNING = ("main", "<module>")  # functions in which a correct server spins


@dataclass(frozen=True)
class Place:
    """A line of the student's file, and the function that it was calling."""

    file: str
    line: int
    function: str
    calls: str  # "" for a built-in function of Python, such as time.sleep

    def __str__(self) -> str:
        calls = f", which called {self.calls}()" if self.calls else ""
        return f"line {self.line} of {self.file}, in {self.function}(){calls}"


def with_code(advice: str, sources: Mapping[str, str]) -> str:
    """Return advice that quotes each line of the student's files that it names; `sources` are their texts by name."""

    def quoted(place: re.Match[str]) -> str:
        lines = sources.get(place[2], "").splitlines()
        line = lines[int(place[1]) - 1].strip() if int(place[1]) <= len(lines) else ""
        return f"{place[0]} (`{line}`)" if line else place[0]

    return _PLACE.sub(quoted, advice)


def where_it_waited(run: Record, *, in_main: bool = False) -> Place | None:
    """Return where a thread was blocked in a callback when the program was ended; None if no thread was.

    `in_main` also considers main(), in which a client waits, but a server only spins.
    """
    stack = run.first(ev.NodeStack)
    if stack is None:
        return None
    threads = "\n".join(stack.lines).split("(most recent call first):")[1:]
    if in_main:
        threads.reverse()  # Python lists the main thread last
    for thread in threads:
        place = _innermost(thread)
        if place and (in_main or not _spins(place, thread)):
            return place
    return None


def why_nobody_serves(run: Record) -> str | None:
    """Return what to do if no thread of a server was spinning, or in a callback, when it was ended; else None."""
    stack = run.first(ev.NodeStack)
    main = where_it_waited(run, in_main=True)
    if stack is None or main is None or main.function not in _SPINNING:
        return None
    if any(function.startswith("spin") for line in stack.lines for *_, function in _FRAME.findall(line)):
        return None
    return f"No thread runs the node's callbacks: it was in {main}, and not in rclpy.spin(node)."


def _spins(place: Place, thread: str) -> bool:
    """Whether a thread was in main(), or in another function that spins, and not in a callback of rclpy."""
    callers = thread.partition(f"line {place.line} in {place.function}")[2]
    return place.function in _SPINNING or (place.calls.startswith("spin") and "/rclpy/" not in callers)


def _innermost(thread: str) -> Place | None:
    """Return the innermost line of a thread that is in the student's file."""
    calls = ""
    for path, line, function in _FRAME.findall(thread):
        if own := OWN_FILE.search(path):
            return Place(own[1], int(line), function, calls)
        calls = function
    return None
