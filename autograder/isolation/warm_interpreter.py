"""The arena's side of `ros_runtime/warm_start`: an interpreter that waits to become students' programs.

It is executed, never forked, from the arena's own process: nothing of the grader is in its memory.
"""

from __future__ import annotations

import json
import os
import socket
import subprocess
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

import ros_runtime.warm_start
from autograder.isolation.bubblewrap import STUDENT_FILTER, SandboxError, StartedSandbox
from autograder.isolation.running_program import EnteredProgram

_STARTER = Path(ros_runtime.warm_start.__file__).with_name("starter.py")


class WarmInterpreter:
    """Starts waiting at once; `environment` is what every program's environment begins with."""

    def __init__(self, environment: Mapping[str, str]) -> None:
        self._orders, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        with theirs:
            self._process = subprocess.Popen(
                [sys.executable, str(_STARTER), str(theirs.fileno())],
                env=dict(environment),
                pass_fds=[theirs.fileno()],
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
            )

    @property
    def pid(self) -> int:
        """Its process id."""
        return self._process.pid

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

        Raises :class:`.bubblewrap.SandboxError` when it cannot enter.
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
