"""The specification of an arena: what it runs, sees and may use."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from enum import Enum
from pathlib import Path

from autograder.isolation.limits import ArenaLimits

ISOLATION_VARIABLE = "COURSE_ISOLATION"  # inside an arena: its kind; outside: the kind the user asks for


class Kind(str, Enum):
    """What keeps an arena apart from the rest of the machine."""

    NAMESPACES = "namespaces"
    ANOTHER_USER = (
        "another-user"  # the student's program alone: root of a container without namespaces steps down
    )
    NONE = "none"


@dataclass(frozen=True)
class ArenaSpec:
    """What to run and what it may see and use.

    `read_only_paths` are host files and folders, visible at the same place inside; files keep their identity,
    so a mapped page can be shared. `pass_fds` are descriptors inherited under the same number: the caller
    closes its own copies of them once the arena has started. `stdin` is all that the command can read there.
    `waiting_env`, if given, is the environment of an interpreter that waits in the arena to become students'
    programs (`warm_interpreter`); the command is then `python -m MODULE …`. Without namespaces none waits.
    """

    command: Sequence[str]
    read_only_paths: Sequence[str | Path] = ()
    env: Mapping[str, str] = field(default_factory=dict)
    waiting_env: Mapping[str, str] | None = None
    pass_fds: Sequence[int] = ()
    stdin: bytes = b""
    limits: ArenaLimits = field(default_factory=ArenaLimits)
