"""End a process when its parent dies, by the kernel's parent-death signal.

As a program, `python die_with_parent.py PARENT_PID PROGRAM ARGUMENT…` becomes PROGRAM. Use it instead of a function
between fork and exec (`preexec_fn`): another thread may hold a lock at the moment of the fork. It needs the standard
library alone, so it runs with `-I -S`.
"""

from __future__ import annotations

import ctypes
import os
import signal
import sys

_PR_SET_PDEATHSIG = 1  # from linux/prctl.h


def die_with_parent(parent: int, number: int = signal.SIGKILL) -> bool:
    """Ask the kernel for a signal to this process when its parent dies.

    The kernel counts the thread that started this process as its parent, and forgets the request when the process
    changes its user id.

    Args:
        parent: the parent's process id.
        number: of the signal.

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
    """Become the program that the command line names."""
    if not die_with_parent(int(sys.argv[1])):
        sys.exit("the parent has already ended")
    os.execvp(sys.argv[2], sys.argv[2:])


if __name__ == "__main__":
    main()
