"""What gradings leave behind on this machine: nothing, if they are sound.

    with residue() as left:
        grade(…)
    assert not left

It sees what belongs to this process alone, so others may grade on the same machine.
"""

from __future__ import annotations

import ctypes
import os
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from autograder.isolation.memory_group import group_folders
from autograder.isolation.process_tree import descendants

_PR_SET_CHILD_SUBREAPER = 36
_SHARED_MEMORY = Path("/dev/shm")
_MIDDLEWARES = ("fastrtps", "fastdds", "lttng", "sem.")  # how files in shared memory begin that a node leaves


@contextmanager
def residue(patience: float = 5.0) -> Iterator[list[str]]:
    """Yield a list, empty until the block ends, then of what is left that was not there before, each in words.

    What has been ended may take `patience` s to be gone.
    """
    ctypes.CDLL(None).prctl(_PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)  # orphans become our children, and are found
    before, left = _seen(), list[str]()
    yield left
    deadline = time.monotonic() + patience
    while (now := _seen() - before) and time.monotonic() < deadline:
        time.sleep(0.05)
    left += sorted(now)


def _seen() -> set[str]:
    return {*_processes(), *_mounts(), *_files(), *_locks(), *_groups()}


def _processes() -> Iterator[str]:
    for pid in descendants(os.getpid()):
        try:
            name = Path(f"/proc/{pid}/comm").read_text().strip()
            state = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
        except OSError:  # it has ended just now
            continue
        if state != "Z":  # one that has ended waits for the system's first process, in whose place we are
            yield f"process {pid}, {name}"


def _mounts() -> Iterator[str]:
    for line in Path("/proc/self/mountinfo").read_text().splitlines():
        where = line.split()[4]
        if _is_ours(where):
            yield f"mount {where}"


def _files() -> Iterator[str]:
    for folder in {Path("/tmp"), Path(tempfile.gettempdir())}:
        yield from (f"file {path}" for path in folder.iterdir() if _is_ours(path.name))
    if _SHARED_MEMORY.is_dir():
        yield from (f"file {path}" for path in _SHARED_MEMORY.iterdir() if path.name.startswith(_MIDDLEWARES))


def _groups() -> Iterator[str]:
    yield from (f"control group {folder}" for folder in group_folders())


def _is_ours(name: str) -> bool:
    return f"arena-{os.getpid()}-" in name


def _locks() -> Iterator[str]:
    """Yield the locks of ROS domains, among others, that this process holds."""
    for line in Path("/proc/locks").read_text().splitlines():
        kind, _, _, pid, where = line.replace("->", "").split()[1:6]
        if kind == "FLOCK" and int(pid) == os.getpid():
            yield f"lock on {where}"
