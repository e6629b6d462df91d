"""The arena's side of `ros_runtime/warm_start`: an interpreter that waits to become students' programs.

The arena's first process forks it before it loads anything of the grader: nothing of that is in its memory.
"""

from __future__ import annotations

import json
import os
import socket
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path

import ros_runtime.warm_start
from autograder.isolation.bubblewrap import STUDENT_FILTER, SandboxError, StartedSandbox
from autograder.isolation.running_program import EnteredProgram

_FIRST_PROCESS = Path(ros_runtime.warm_start.__file__).with_name("first_process.py")


@contextmanager
def first_process(command: Sequence[str], environment: Mapping[str, str]) -> Iterator[tuple[list[str], int]]:
    """Yield the command that forks a waiting interpreter before it goes on as `command`, `python -m MODULE …`.

    The descriptor that comes with it is to be inherited; it holds command and environment.
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
    """A waiting interpreter, by the socket that takes its orders and its process id."""

    def __init__(self, orders: socket.socket, pid: int) -> None:
        self._orders = orders
        self.pid = pid

    @classmethod
    def in_this_arena(cls) -> WarmInterpreter | None:
        """Return the one that the first process of this arena, which is this process, has forked, if it has."""
        waiting = os.environ.get(ros_runtime.warm_start.WAITING)
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
