"""Finds what gradings leave behind on this machine; a correct grading leaves nothing.

    with leftovers() as left:
        grade(…)
    assert not left

It considers only resources of this process, and files in shared memory that no process uses, so other gradings and
nodes may run on the same machine.
"""

from __future__ import annotations

import ctypes
import os
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from autograder.isolation.memory_group import group_folders
from autograder.isolation.process_tree import descendants

_PR_SET_CHILD_SUBREAPER = 36
_SHARED_MEMORY = Path("/dev/shm")
# How files in shared memory begin that a node leaves. LTTng's are kept, by design, for each user who ever ran one.
_MIDDLEWARES = ("fastrtps", "fastdds", "sem.")


@contextmanager
def leftovers(patience: float = 5.0) -> Iterator[list[str]]:
    """Yield a list that is filled when the block ends: one description for each new leftover.

    Processes that were ended get `patience` s to disappear.
    """
    ctypes.CDLL(None).prctl(_PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)  # orphans become our children, and are found
    before, left = {*_seen(), *(f"file {path}" for path in _of_nodes())}, list[str]()
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
    yield from (f"file {path}" for path in _abandoned())


def _abandoned() -> Iterator[Path]:
    """Yield the files that nodes have left in shared memory: those that no process has mapped."""
    found = list(_of_nodes())
    mapped = _mapped() if found else set()
    for path in found:
        with suppress(FileNotFoundError):  # it has gone just now
            status = path.stat()
            if (os.major(status.st_dev), os.minor(status.st_dev), status.st_ino) not in mapped:
                yield path


def _of_nodes() -> Iterator[Path]:
    if _SHARED_MEMORY.is_dir():
        yield from (path for path in _SHARED_MEMORY.iterdir() if path.name.startswith(_MIDDLEWARES))


def _mapped() -> set[tuple[int, int, int]]:
    """Return the files in shared memory that processes have mapped, each as its device's two numbers and its own."""
    files = set()
    for maps in Path("/proc").glob("[0-9]*/maps"):
        with suppress(OSError):  # it has ended, or is another user's
            for line in maps.read_text().splitlines():
                _, _, _, device, number, *path = line.split(maxsplit=5)
                if path and path[0].startswith(str(_SHARED_MEMORY)):
                    major, minor = device.split(":")
                    files.add((int(major, 16), int(minor, 16), int(number)))
    return files


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
