"""End a process when its parent dies, by the kernel's parent-death signal.

As a program, `python die_with_parent.py PARENT_PID PROGRAM ARGUMENT…` does so and then executes PROGRAM. Use it
instead of a function between fork and exec (`preexec_fn`), because another thread may hold a lock at the moment of the
fork. It needs only the standard library, so it runs with `-I -S`.
"""

from __future__ import annotations

import ctypes
import os
import signal
import sys

_PR_SET_PDEATHSIG = 1  # from linux/prctl.h


def die_with_parent(parent: int, number: int = signal.SIGKILL) -> bool:
    """Request from the kernel that it sends this process a signal when its parent dies.

    For the kernel, the parent is the thread that started this process. The kernel drops the request when the process
    changes its user id.

    Args:
        parent: the parent's process id.
        number: the number of the signal.

    Returns:
        Whether the parent is still alive. If not, no signal will come.

    Raises:
        OSError: the kernel refuses.
    """
    libc = ctypes.CDLL(None, use_errno=True)
    if libc.prctl(_PR_SET_PDEATHSIG, number, 0, 0, 0) != 0:
        raise OSError(ctypes.get_errno(), "prctl(PR_SET_PDEATHSIG)")
    return os.getppid() == parent


def main() -> None:
    """Replace this process by the program on the command line."""
    if not die_with_parent(int(sys.argv[1])):
        sys.exit("the parent has already ended")
    os.execvp(sys.argv[2], sys.argv[2:])


if __name__ == "__main__":
    main()
