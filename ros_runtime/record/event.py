"""The base class of all events, and their conversion to lines of JSON."""

from __future__ import annotations

import json
import re
import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar

from typing_extensions import dataclass_transform  # in typing since Python 3.11

from ros_runtime.messages import is_message, to_dict, type_name


@dataclass_transform(frozen_default=True, kw_only_default=True)
@dataclass(frozen=True, kw_only=True)
class Event:
    """Something that happened at `t` (s, `time.monotonic()` of the process that observed it; by default now).

    Subclasses are dataclasses, too. `kind` is the name of the class in snake case.
    """

    kind: ClassVar[str]
    t: float = field(default_factory=time.monotonic)

    def __init_subclass__(cls) -> None:
        cls.kind = re.sub(r"(?<!^)(?=[A-Z])", "_", cls.__name__).lower()
        dataclass(frozen=True, kw_only=True)(cls)


def to_line(event: Event) -> bytes:
    """Return an event as one line of JSON; each ROS message in it is stored with its type name."""
    return as_line(event.kind, to_json(event))


def as_line(kind: str, fields: Mapping[str, Any]) -> bytes:
    """Return an event's kind and fields as one line of JSON; the fields are those that `to_json` returns."""
    return json.dumps({"kind": kind, **fields}).encode() + b"\n"


def to_json(event: Event) -> dict[str, Any]:
    """Return the fields of an event as values that JSON can hold."""
    return {name: _to_json(value) for name, value in vars(event).items()}


def _to_json(value: Any) -> Any:
    if is_message(value):
        return {"ros_type": type_name(value), "ros_fields": to_dict(value)}
    return value
