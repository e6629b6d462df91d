"""Limits the memory of an arena with a control group (cgroup), where this user may create one.

The kernel also counts memory that is in no process's resident size: shared memory that is no longer mapped, files in
memory, socket buffers. Without a group the grader limits resident sizes, file system sizes and the number of sockets.
"""

from __future__ import annotations

import os
import time
from contextlib import suppress
from dataclasses import dataclass
from itertools import count
from pathlib import Path

_numbers = count()


@dataclass(frozen=True)
class _Version:
    """The paths and file names of one of the two cgroup versions."""

    place: Path  # where the groups are made
    limits: tuple[str, ...]  # files for the limit in bytes; those after the first may be missing
    no_swap: str  # file for how much may be swapped out
    kills: str  # file with a line `oom_kill NUMBER`


_VERSION_2 = _Version(
    Path("/sys/fs/cgroup"), limits=("memory.max",), no_swap="memory.swap.max", kills="memory.events"
)
_VERSION_1 = _Version(
    Path("/sys/fs/cgroup/memory"),
    limits=("memory.limit_in_bytes", "memory.kmem.tcp.limit_in_bytes"),
    no_swap="memory.swappiness",
    kills="memory.oom_control",
)


class MemoryGroup:
    """A control group with a limit of memory, for one process and all that it starts from then on."""

    def __init__(self, folder: Path, kills: str) -> None:
        self._folder = folder
        self._kills = folder / kills

    def add(self, pid: int) -> None:
        """Put a process into the group; raises OSError when it is gone."""
        (self._folder / "cgroup.procs").write_text(str(pid))

    def was_exceeded(self) -> bool:
        """Return whether the kernel has ended a process because the group was at its limit."""
        for line in self._kills.read_text().splitlines():
            name, _, number = line.partition(" ")
            if name == "oom_kill":
                return int(number) > 0
        return False

    def remove(self) -> None:
        """Remove the group once its last process has ended."""
        remove_group(self._folder)


def remove_group(folder: Path, patience: float = 2.0) -> None:
    """Remove a control group once its last process has left it, which may take `patience` s."""
    deadline = time.monotonic() + patience
    while folder.exists() and time.monotonic() < deadline:
        with suppress(OSError):
            folder.rmdir()
            return
        time.sleep(0.02)


def make_memory_group(limit_mib: float) -> MemoryGroup | None:
    """Make a group with a limit, or return None where the kernel or this user's rights do not allow it."""
    for version in (_VERSION_1, _VERSION_2):
        group = _make(version, int(limit_mib * 2**20))
        if group:
            return group
    return None


def _make(version: _Version, limit: int) -> MemoryGroup | None:
    folder = version.place / f"arena-{os.getpid()}-{next(_numbers)}"
    try:
        _sweep(version.place)
        folder.mkdir()
    except OSError:
        return None
    try:
        first, *others = (folder / name for name in version.limits)
        with first.open("r+") as file:  # "r+" creates no file: without the memory controller it is missing
            file.write(str(limit))
        for path, value in [*((path, limit) for path in others), (folder / version.no_swap, 0)]:
            with suppress(OSError), path.open("r+") as file:
                file.write(str(value))
        group = MemoryGroup(folder, version.kills)
        group.was_exceeded()  # raises OSError if the counter cannot be read
    except OSError:
        folder.rmdir()
        return None
    return group


def _sweep(place: Path) -> None:
    """Remove the groups that killed graders have left."""
    for folder in place.glob("arena-*-*"):
        pid = folder.name.split("-")[1]
        if pid.isdigit() and not Path(f"/proc/{pid}").exists():
            with suppress(OSError):
                folder.rmdir()
