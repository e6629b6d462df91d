"""The events of a transcript, and the parser for the lines of an arena's report.

The lines come from a process that parses bytes written by untrusted code, so they are validated here before they are
judged.
"""

from __future__ import annotations

import json
from functools import cache
from typing import Any

from pydantic import ConfigDict, TypeAdapter

from autograder.arena.events import *  # noqa: F403
from autograder.arena.events import KINDS
from ros_runtime.messages import from_dict, message_type
from ros_runtime.record.event import Event

_CONFIG = ConfigDict(extra="forbid", allow_inf_nan=True)


def parse_event(line: bytes | str) -> Event:
    """Read one line of an arena's report.

    Raises:
        ValueError: it is no event; a pydantic.ValidationError says which field is wrong.
    """
    try:
        fields = json.loads(line, object_hook=_message_or_dict)
    except (RecursionError, OverflowError) as error:  # thousands of brackets, or a number that is too large
        raise ValueError(f"this is no event: {error}") from error
    if not isinstance(fields, dict) or "t" not in fields:
        raise ValueError(f"an event is an object with a time t, not {line[:200]!r}")
    kind = fields.pop("kind", None)
    if not isinstance(kind, str) or kind not in KINDS:
        raise ValueError(f"there is no kind of event {str(kind)[:200]!r}")
    return _adapter(kind).validate_python(fields)


@cache
def _adapter(kind: str) -> TypeAdapter[Event]:
    event = KINDS[kind]
    event.__pydantic_config__ = _CONFIG  # type: ignore[attr-defined]
    return TypeAdapter(event)


def _message_or_dict(value: dict[str, Any]) -> Any:
    """Return the ROS message that a JSON object encodes, or the object itself if it encodes none."""
    if value.keys() != {"ros_type", "ros_fields"}:
        return value
    try:
        return from_dict(message_type(value["ros_type"]), value["ros_fields"], strict=True)
    except (AttributeError, AssertionError, TypeError, OverflowError) as error:
        raise ValueError(f"this is no {str(value['ros_type'])[:200]}: {error}") from error
