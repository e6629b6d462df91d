"""Draws the last call or goal as a sequence diagram."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import groupby

from IPython.display import HTML

from lab.client.interaction_log import log
from lab.client.messages import Message
from lab.errors import LabError
from ros_runtime.drawing.sequence_diagram import sequence_svg
from ros_runtime.drawing.svg import shorten

LABEL_LENGTH = 120  # characters, in four lines between two lifelines


def draw_sequence(title: str = "What just happened") -> HTML:
    """Draw the last call or goal and all messages since then: requests solid, answers dashed, topics dotted.

    If there are many feedback messages, only the first and the last one are drawn.

    Raises LabError when no service was called and no goal was sent yet.
    """
    messages = log.messages()
    if not messages:
        raise LabError("there is no call or goal to draw yet: use lab.call() or lab.send_goal() first")
    start = messages[0].time
    arrows = [
        replace(message, time=message.time - start, label=shorten(message.label, LABEL_LENGTH))
        for message in _without_repetition(messages)
    ]
    return HTML(sequence_svg(arrows, title=title))


def _without_repetition(messages: Sequence[Message]) -> list[Message]:
    """Return the messages, with the middle of each stream replaced by one message with the number of those left out."""
    kept: list[Message] = []
    for (repeats, _sender), group in groupby(messages, key=lambda message: (message.repeats, message.sender)):
        stream = list(group)
        if repeats and len(stream) > 3:
            middle = replace(stream[len(stream) // 2], label=f"… {len(stream) - 2} more …")
            stream = [stream[0], middle, stream[-1]]
        kept += stream
    return kept
