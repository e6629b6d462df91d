"""Walks a tree of processes through /proc, from outside and without their help."""

from __future__ import annotations

import os
import select
from collections.abc import Iterable, Iterator
from pathlib import Path

_PAGE_BYTES = os.sysconf("SC_PAGE_SIZE")
_TICKS_PER_SECOND = os.sysconf("SC_CLK_TCK")
_KERNEL_LISTS_CHILDREN = Path("/proc/self/task", str(os.getpid()), "children").exists()


def children(pid: int) -> list[int]:
    """Return the ids of a process's children, those started by any of its threads; [] when it is gone."""
    if not _KERNEL_LISTS_CHILDREN:
        return [child for child, parent in _parents() if parent == pid]
    found: list[int] = []
    for thread in _list(f"/proc/{pid}/task"):
        found += map(int, _read(f"/proc/{pid}/task/{thread}/children").split())
    return found


def descendants(pid: int) -> list[int]:
    """Return the ids of everything below a process; orphans stay below the init that adopts them."""
    found: list[int] = []
    waiting = [pid]
    while waiting:
        below = children(waiting.pop())
        found += below
        waiting += below
    return found


def resident_mib(pids: Iterable[int]) -> float:
    """Return the sum of the resident memory of these processes in MiB; pages they share count once each."""
    pages = 0
    for pid in pids:
        fields = _read(f"/proc/{pid}/statm").split()
        pages += int(fields[1]) if fields else 0
    return pages * _PAGE_BYTES / 2**20


def cpu_seconds(pids: Iterable[int]) -> float:
    """Return the processor time (s) these processes and their ended children have used."""
    ticks = 0
    for pid in pids:
        fields = _read(f"/proc/{pid}/stat").rpartition(")")[2].split()
        ticks += sum(map(int, fields[11:15]))
    return ticks / _TICKS_PER_SECOND


def seconds_without_a_processor(pid: int) -> float:
    """Return how long (s) a process's main thread was runnable but not running; 0 if the kernel does not count it."""
    fields = _read(f"/proc/{pid}/schedstat").split()
    return int(fields[1]) / 1e9 if len(fields) > 1 else 0.0


def is_asleep(pid: int) -> bool:
    """Whether a process is in interruptible sleep (state S)."""
    return _read(f"/proc/{pid}/stat").rpartition(")")[2].split()[:1] == ["S"]


def ended_within(pidfd: int, seconds: float) -> bool:
    """Wait at most `seconds` for the end of a process; return whether it has ended."""
    poll = select.poll()
    poll.register(pidfd, select.POLLIN)
    return bool(poll.poll(seconds * 1000))


def _parents() -> Iterator[tuple[int, int]]:
    for name in _list("/proc"):
        if name.isdigit() and (stat := _read(f"/proc/{name}/stat")):
            yield int(name), int(stat.rpartition(")")[2].split()[1])


def _list(folder: str) -> list[str]:
    try:
        return os.listdir(folder)
    except OSError:
        return []


def _read(path: str) -> str:
    try:
        return Path(path).read_text()
    except OSError:  # the process ended between two looks
        return ""
