"""Runs a command and ends every process it leaves behind, on machines without namespaces.

Orphans of the command become children of this process, so it can end them all: when the command has ended,
at SIGTERM, and when the process that started it dies. Its exit status is the
command's, 128 + n after signal n.

Run as `python -S -E -m autograder.isolation.reaper PARENT READY FOLDER COMMAND…`, where PARENT is the id of the
process that starts it, READY the descriptor it writes to when it is ready, and FOLDER where the command runs.
"""

from __future__ import annotations

import ctypes
import os
import signal
import sys
import time
from contextlib import suppress

from autograder.isolation.process_tree import descendants
from ros_runtime.workarounds.die_with_parent import die_with_parent

_PR_SET_CHILD_SUBREAPER = 36


class _StopRequestedError(Exception):
    pass


def main() -> None:
    """Adopt orphans, run the command, and end what it leaves behind."""
    ctypes.CDLL(None).prctl(_PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)
    signal.signal(signal.SIGTERM, _stop)
    parent_lives = die_with_parent(int(sys.argv[1]), signal.SIGTERM)
    status = 128 + signal.SIGKILL
    with suppress(_StopRequestedError):
        os.write(int(sys.argv[2]), b"x")
        os.close(int(sys.argv[2]))
        if parent_lives:
            status = _run(sys.argv[3], sys.argv[4:])
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    _sweep()
    os._exit(status)


def _run(folder: str, command: list[str]) -> int:
    pid = os.fork()
    if pid == 0:
        try:
            signal.signal(signal.SIGTERM, signal.SIG_DFL)
            os.setsid()
            os.chdir(folder)
            os.execvp(command[0], command)
        except OSError as error:
            os.write(2, f"{command[0]}: {error}\n".encode())
        os._exit(127)
    while True:
        ended, status = os.wait()
        if ended == pid:
            code = os.waitstatus_to_exitcode(status)
            return code if code >= 0 else 128 - code


def _sweep() -> None:
    """End everything below this process; stop the processes first, so that they cannot fork faster than they end."""
    me = os.getpid()
    while below := descendants(me):
        for number in (signal.SIGSTOP, signal.SIGKILL):
            for pid in below:
                with suppress(ProcessLookupError, PermissionError):
                    os.kill(pid, number)
        with suppress(ChildProcessError):
            while os.waitpid(-1, os.WNOHANG)[0]:
                pass
        time.sleep(0.001)


def _stop(number: int, frame: object) -> None:
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    raise _StopRequestedError


if __name__ == "__main__":
    main()
