"""Counts sockets through /proc: those of a whole private network, or those of some processes in a shared one."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from contextlib import suppress
from pathlib import Path

from autograder.isolation.limits import StudentLimits

_NETWORK = Path("/proc/net")
_OWNER, _NUMBER = 7, 9  # columns of the tables of TCP and UDP sockets


def too_many_sockets(processes: Iterable[int], limits: StudentLimits, private_network: bool) -> str:
    """Return the reason if a student's processes exceed a limit on sockets, else "".

    In an arena's private network every socket counts, even one that no process holds at the moment. In a shared network
    only sockets held by these processes count.
    """
    if private_network:
        held, tcp = _of_the_network()
        had = "the arena had"
    else:
        own = _of_processes(processes)
        # the TCP table lists all connections of the machine, so it is read only if needed
        held, tcp = len(own), len(own & _numbers("tcp")) if len(own) > limits.tcp_sockets else 0
        had = "it had"
    if held > limits.sockets:
        return f"{had} {held:,} sockets; {limits.sockets} are allowed"
    if tcp > limits.tcp_sockets:
        return f"{had} {tcp:,} TCP sockets; {limits.tcp_sockets} are allowed"
    return ""


def _of_the_network() -> tuple[int, int]:
    """Return how many sockets this process's network has, and how many of them are TCP's."""
    used = tcp = 0
    for file in ("sockstat", "sockstat6"):
        for line in _lines(_NETWORK / file):
            name, _, count = line.split()[:3]
            used += int(count) if name == "sockets:" else 0
            tcp += int(count) if name in ("TCP:", "TCP6:") else 0
    return used, tcp


def _of_processes(pids: Iterable[int]) -> set[str]:
    """Return the numbers of the sockets that these processes hold, each once.

    If root in a container cannot list a process's descriptors, all TCP and UDP sockets of its user are counted.
    """
    found: set[str] = set()
    hidden: set[str] = set()
    for pid in pids:
        try:
            found |= set(_held(pid))
        except PermissionError:
            hidden |= _users(pid)
    for user in hidden - {str(os.getuid())}:
        found |= _numbers("tcp", user) | _numbers("udp", user)
    return found


def _held(pid: int) -> Iterator[str]:
    with suppress(FileNotFoundError, ProcessLookupError):  # it has ended
        for descriptor in os.listdir(f"/proc/{pid}/fd"):
            with suppress(FileNotFoundError):  # closed between two looks
                target = os.readlink(f"/proc/{pid}/fd/{descriptor}")
                if target.startswith("socket:["):
                    yield target[len("socket:[") : -1]


def _numbers(protocol: str, user: str = "") -> set[str]:
    """Return the numbers of a protocol's sockets that processes hold, of all users or of one."""
    rows = (line.split() for name in (protocol, f"{protocol}6") for line in _lines(_NETWORK / name))
    return {
        row[_NUMBER]
        for row in rows
        if row[_NUMBER].isdigit() and row[_NUMBER] != "0" and user in ("", row[_OWNER])
    }


def _users(pid: int) -> set[str]:
    """Return the user id of a process as a set of one; empty if the process has ended."""
    return {line.split()[1] for line in _lines(Path(f"/proc/{pid}/status")) if line.startswith("Uid:")}


def _lines(path: Path) -> Iterator[str]:
    try:
        yield from path.read_text().splitlines()
    except OSError:  # the kernel has no such protocol, or the process ended between two looks
        return
