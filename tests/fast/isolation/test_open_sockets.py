"""With a shared network, the limit of sockets counts only the student's own sockets."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager

import pytest

from autograder.isolation.limits import StudentLimits
from autograder.isolation.open_sockets import too_many_sockets

LIMITS = StudentLimits()
CONNECTIONS = 40  # with both ends, more TCP sockets than a student may have
HOLDS_CONNECTIONS = f"""
import socket
server = socket.create_server(("127.0.0.1", 0))
held = [end for _ in range({CONNECTIONS}) for end in (socket.create_connection(server.getsockname()), server.accept())]
print("holds them", flush=True)
input()
"""
HOLDS_NONE = "print('holds none', flush=True)\ninput()"
TOO_MUCH_TCP = "it had 81 TCP sockets; 64 are allowed"
HOLDS_PAIRS = """
import socket
held = [socket.socketpair() for _ in range(400)]
print("holds them", flush=True)
input()
"""


@contextmanager
def running(code: str) -> Iterator[int]:
    """A process that runs the code and keeps its objects open."""
    with subprocess.Popen(
        [sys.executable, "-c", code], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    ) as process:
        assert process.stdout
        assert process.stdout.readline().startswith(b"holds")
        yield process.pid
        process.communicate(b"\n")


@pytest.mark.parametrize(
    ("code", "reason"),
    [(HOLDS_CONNECTIONS, TOO_MUCH_TCP), (HOLDS_PAIRS, "it had 800 sockets; 700 are allowed")],
    ids=["TCP", "all"],
)
def test_only_a_programs_own_sockets_count_against_it(code: str, reason: str) -> None:
    with running(code) as other, running(HOLDS_NONE) as student:
        assert too_many_sockets([student], LIMITS, private_network=False) == ""
        assert too_many_sockets([other, student, other], LIMITS, private_network=False) == reason


@pytest.mark.skipif(os.geteuid() != 0, reason="only root runs programs as another user")
def test_a_root_that_may_not_see_descriptors_counts_the_other_users_connections() -> None:
    """As in Docker, whose root has no right to trace."""
    look = f"""
import sys
from {too_many_sockets.__module__} import too_many_sockets, StudentLimits
print(too_many_sockets([int(sys.argv[1])], StudentLimits(), private_network=False))
"""
    weak = ["/usr/bin/setpriv", "--bounding-set=-sys_ptrace", "--inh-caps=-all", sys.executable, "-c", look]
    step_down = (
        "import encodings.idna, os, socket  # while it may read them\nos.setresuid(54321, 54321, 54321)\n"
    )
    with running(HOLDS_CONNECTIONS), running(step_down + HOLDS_CONNECTIONS) as student:
        assert subprocess.check_output([*weak, str(student)], text=True) == TOO_MUCH_TCP + "\n"
    with running(HOLDS_CONNECTIONS), running(step_down + HOLDS_NONE) as student:
        assert subprocess.check_output([*weak, str(student)], text=True) == "\n"
