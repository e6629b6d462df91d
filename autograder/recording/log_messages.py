"""Makes log messages (rcl_interfaces/Log) of a run's events, of the program's output, and of the verdicts."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from rcl_interfaces.msg import Log

from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.engine.verdict import CheckVerdict
from autograder.recording.entry import CHECKS, EVENTS, ROSOUT, Entry, stamp
from autograder.recording.narration import narrated

_OF_RCLPY = re.compile(r"\[(DEBUG|INFO|WARN|ERROR|FATAL)\] \[[\d.]+\] \[([^\]]*)\]: (.*)", re.DOTALL)


@dataclass(frozen=True)
class RecordedVerdict:
    """A verdict in the recording of a run.

    Attributes:
        verdict: the verdict itself.
        from_another_run: the check judged another run of this scenario than the recorded one.
        other_scenarios: names of further scenarios that the check judged; the verdict's time may be from any of them.
    """

    verdict: CheckVerdict
    from_another_run: bool = False
    other_scenarios: Sequence[str] = ()


def log_messages(transcript: Transcript, program: str) -> Iterator[Entry]:
    """Yield the events of the run (/arena/events) and the program's output (/rosout)."""
    for event in transcript.events:
        if isinstance(event, ev.NodeOutput):
            yield Entry(event.t, ROSOUT, _printed(event, program))
        elif described := narrated(event):
            yield Entry(event.t, EVENTS, log(event.t, described[0], "arena", described[1]))


def verdict_messages(judged: Iterable[RecordedVerdict], end: float) -> Iterator[Entry]:
    """Yield each verdict at its time: a failed check as ERROR, a passed check as INFO, any other verdict as WARN.

    A verdict without a time, or from another run, is placed at `end` (s).
    """
    for each in judged:
        verdict = each.verdict
        at = (
            end
            if verdict.robot_time is None or each.from_another_run
            else min(max(verdict.robot_time, 0.0), end)
        )
        level = {"failed": Log.ERROR, "passed": Log.INFO}.get(verdict.status, Log.WARN)
        message = log(at, level, CHECKS, _sentence(each), function=verdict.id)
        yield Entry(at, ROSOUT, message, essential=True)


def log(t: float, level: int, name: str, text: str, function: str = "") -> Log:
    """Return a log message."""
    return Log(stamp=stamp(t), level=level, name=_text(name), msg=_text(text), function=_text(function))


def _printed(event: ev.NodeOutput, program: str) -> Any:
    """Return a line of output as a log message, with rclpy's level if the line has one, else WARN for stderr."""
    if match := _OF_RCLPY.fullmatch(event.text):
        return log(event.t, getattr(Log, match[1]), match[2], match[3])
    return log(event.t, Log.INFO if event.stream == "stdout" else Log.WARN, program, event.text)


def _sentence(judged: RecordedVerdict) -> str:
    verdict = judged.verdict
    parts = [f"{verdict.status}: {verdict.title} ({verdict.points:g}/{verdict.max_points}, {verdict.id})"]
    parts += [f"expected {verdict.expected}"] if verdict.expected else []
    parts += [f"observed {verdict.observed}"] if verdict.observed else []
    if verdict.status == "failed" and verdict.help:
        parts.append(verdict.help)
    if judged.other_scenarios:
        parts.append(f"judged on {', '.join(judged.other_scenarios)}, too; the time may be from one of these")
    if judged.from_another_run:
        parts.append("judged on another run of this scenario, not on the recorded one")
    return "; ".join(parts)


def _text(text: str) -> str:
    """Return the text without characters that UTF-8 or C strings cannot hold."""
    return text.encode("utf-8", "replace").decode().replace("\0", "␀")
