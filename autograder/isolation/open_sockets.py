"""Counts sockets through /proc: those of a whole network, or those of some processes in a network that others share."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from contextlib import suppress
from pathlib import Path

from autograder.isolation.limits import StudentLimits

_NETWORK = Path("/proc/net")
_OWNER, _NUMBER = 7, 9  # columns of the tables of TCP and UDP sockets


def too_many_sockets(processes: Iterable[int], limits: StudentLimits, private_network: bool) -> str:
    """Return which limit of sockets a student's processes exceed, as a reason; empty: none.

    In an arena's private network every socket is counted, also one that no process holds at the moment. A network that
    is shared has the sockets of others, so there only what the processes hold counts.
    """
    if private_network:
        held, tcp = _of_the_network()
        had = "with it there were"
    else:
        own = _of_processes(processes)
        # the table has all connections of the machine: it is read only when it can matter
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

    A container's root may not see what another user's processes hold; then it is what TCP and UDP have of that user's.
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
    """Return the user whose process it is; none when it has ended."""
    return {line.split()[1] for line in _lines(Path(f"/proc/{pid}/status")) if line.startswith("Uid:")}


def _lines(path: Path) -> Iterator[str]:
    try:
        yield from path.read_text().splitlines()
    except OSError:  # the kernel has no such protocol, or the process ended between two looks
        return
