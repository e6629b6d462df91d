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

from autograder.isolation.process_tree import descendants

_PR_SET_CHILD_SUBREAPER = 36
_SHARED_MEMORY = Path("/dev/shm")
# The beginnings of the names of files that a node leaves in shared memory. LTTng keeps its files there by design.
_NODE_FILE_PREFIXES = ("fastrtps", "fastdds", "sem.")


@contextmanager
def leftovers(timeout: float = 5.0) -> Iterator[list[str]]:
    """Yield a list that is filled when the block ends: one description for each new leftover.

    Processes that were ended have `timeout` s to disappear.
    """
    # Orphaned processes become children of this process, so that `descendants` finds them.
    ctypes.CDLL(None).prctl(_PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)
    before, left = {*_resources(), *(f"file {path}" for path in _node_files())}, list[str]()
    yield left
    deadline = time.monotonic() + timeout
    while (now := _resources() - before) and time.monotonic() < deadline:
        time.sleep(0.05)
    left += sorted(now)


def _resources() -> set[str]:
    return {*_processes(), *_mounts(), *_files(), *_locks(), *_groups()}


def _processes() -> Iterator[str]:
    for pid in descendants(os.getpid()):
        try:
            name = Path(f"/proc/{pid}/comm").read_text().strip()
            state = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
        except OSError:  # the process has just ended
            continue
        if state != "Z":  # a zombie has ended: it waits to be reaped, which init does for other processes
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
    """Yield the files in shared memory that nodes have left behind, which no process has mapped."""
    found = list(_node_files())
    mapped = _mapped() if found else set()
    for path in found:
        with suppress(FileNotFoundError):  # the file was just removed
            status = path.stat()
            if (os.major(status.st_dev), os.minor(status.st_dev), status.st_ino) not in mapped:
                yield path


def _node_files() -> Iterator[Path]:
    if _SHARED_MEMORY.is_dir():
        yield from (path for path in _SHARED_MEMORY.iterdir() if path.name.startswith(_NODE_FILE_PREFIXES))


def _mapped() -> set[tuple[int, int, int]]:
    """Return the files in shared memory that processes have mapped, as device major, device minor and inode."""
    files = set()
    for maps in Path("/proc").glob("[0-9]*/maps"):
        with suppress(OSError):  # the process has ended, or belongs to another user
            for line in maps.read_text().splitlines():
                _, _, _, device, number, *path = line.split(maxsplit=5)
                if path and path[0].startswith(str(_SHARED_MEMORY)):
                    major, minor = device.split(":")
                    files.add((int(major, 16), int(minor, 16), int(number)))
    return files


def group_folders() -> list[Path]:
    """Return the control groups of arenas that this process has made and not yet removed."""
    places = Path("/sys/fs/cgroup"), Path("/sys/fs/cgroup/memory")  # of the two versions of cgroups
    return [folder for place in places for folder in place.glob(f"arena-{os.getpid()}-*")]


def _groups() -> Iterator[str]:
    yield from (f"control group {folder}" for folder in group_folders())


def _is_ours(name: str) -> bool:
    return f"arena-{os.getpid()}-" in name


def _locks() -> Iterator[str]:
    """Yield the file locks that this process holds, such as those on ROS domains."""
    for line in Path("/proc/locks").read_text().splitlines():
        kind, _, _, pid, where = line.replace("->", "").split()[1:6]
        if kind == "FLOCK" and int(pid) == os.getpid():
            yield f"lock on {where}"
