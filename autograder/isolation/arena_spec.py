"""The specification of an arena: what it runs, sees and may use."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from enum import Enum
from pathlib import Path

from autograder.isolation.limits import ArenaLimits

ISOLATION_VARIABLE = "COURSE_ISOLATION"  # inside an arena: its kind; outside: the kind that the user selects


class Kind(str, Enum):
    """What keeps an arena apart from the rest of the machine."""

    NAMESPACES = "namespaces"
    # root in a container without namespaces runs only the student's program as a new user
    ANOTHER_USER = "another-user"
    NONE = "none"


@dataclass(frozen=True)
class ArenaSpec:
    """What to run and what it may see and use.

    `read_only_paths`: host files and folders, at the same path inside; they keep their inodes, so memory-mapped pages
    can be shared. `pass_fds`: descriptors inherited under the same number; the caller closes its own copies after the
    start. `stdin`: the whole input of the command.
    """

    command: Sequence[str]
    read_only_paths: Sequence[str | Path] = ()
    env: Mapping[str, str] = field(default_factory=dict)
    pass_fds: Sequence[int] = ()
    stdin: bytes = b""
    limits: ArenaLimits = field(default_factory=ArenaLimits)
