"""The arena's side of `ros_runtime/workarounds/warm_start`: an interpreter that waits to become students' programs.

The arena's first process forks it before it loads anything of the grader: nothing of that is in its memory.
"""

from __future__ import annotations

import json
import os
import socket
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path

import ros_runtime.workarounds.warm_start
from autograder.isolation.bubblewrap import STUDENT_FILTER, SandboxError, StartedSandbox
from autograder.isolation.running_program import EnteredProgram

_FIRST_PROCESS = Path(ros_runtime.workarounds.warm_start.__file__).with_name("first_process.py")


@contextmanager
def first_process(command: Sequence[str], environment: Mapping[str, str]) -> Iterator[tuple[list[str], int]]:
    """Yield a command line and a descriptor: it forks a waiting interpreter, then runs `command` (`python -m …`).

    The process must inherit the descriptor, which holds the command and its environment.
    """
    python, *arguments = command
    descriptor = os.memfd_create("first process")
    try:
        os.write(descriptor, json.dumps({"arguments": arguments, "environment": dict(environment)}).encode())
        os.lseek(descriptor, 0, os.SEEK_SET)
        yield [python, str(_FIRST_PROCESS), str(descriptor)], descriptor
    finally:
        os.close(descriptor)


class WarmInterpreter:
    """A waiting interpreter, known by its order socket and its process id."""

    def __init__(self, orders: socket.socket, pid: int) -> None:
        self._orders = orders
        self.pid = pid

    @classmethod
    def in_this_arena(cls) -> WarmInterpreter | None:
        """Return the waiting interpreter that this process, the arena's first one, has forked; None without one."""
        waiting = os.environ.get(ros_runtime.workarounds.warm_start.WAITING)
        if waiting is None:
            return None
        descriptor, pid = map(int, waiting.split())
        return cls(socket.socket(fileno=descriptor), pid)

    def start_program(
        self,
        sandbox: StartedSandbox,
        arguments: Sequence[str],
        environment: Mapping[str, str],
        folder: str,
        limits: Mapping[str, int],
        clock: str | None,
    ) -> EnteredProgram:
        """Run the Python file `arguments[0]` in `folder` of an empty sandbox, following the clock's page.

        Raises `SandboxError` when it cannot enter.
        """
        order = {
            "sandbox": sandbox.init_pid,
            "argv": list(arguments),
            "env": dict(environment),
            "folder": folder,
            "limits": dict(limits),
            "clock": clock,
        }
        stdin, our_stdin = os.pipe()
        our_stdout, stdout = os.pipe()
        our_stderr, stderr = os.pipe()
        our_report, report = os.pipe()
        seccomp_filter = os.open(STUDENT_FILTER, os.O_RDONLY)
        given = [stdin, stdout, stderr, report, seccomp_filter]
        ours = [our_stdin, our_stdout, our_stderr, our_report]
        try:
            socket.send_fds(self._orders, [json.dumps(order).encode()], given)
        except OSError as error:
            for descriptor in ours:
                os.close(descriptor)
            raise SandboxError(f"the waiting interpreter takes no orders: {error}") from error
        finally:
            for descriptor in given:
                os.close(descriptor)
        streams = (
            os.fdopen(our_stdin, "wb", buffering=0),
            os.fdopen(our_stdout, "rb", buffering=0),
            os.fdopen(our_stderr, "rb", buffering=0),
        )
        reports = os.fdopen(our_report, "rb", buffering=0)
        answer = reports.readline().decode().strip()
        if not answer.isdigit():
            for stream in (*streams, reports):
                stream.close()
            raise SandboxError(f"a program could not enter its sandbox: {answer or 'no answer'}")
        return EnteredProgram(streams, int(answer), reports, sandbox)
