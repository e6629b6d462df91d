"""Run a program that the kernel ends when its parent dies: `python die_with_parent.py PARENT_PID PROGRAM ARGUMENT…`.

It is a program of its own and no `preexec_fn`: between fork and exec, a lock that another thread of the notebook
kernel held at that moment is never released.
"""

from __future__ import annotations

import ctypes
import os
import signal
import sys

PR_SET_PDEATHSIG = 1  # from linux/prctl.h


def main() -> None:
    """Ask for SIGKILL at the parent's death, then become the program."""
    parent, program = int(sys.argv[1]), sys.argv[2:]
    ctypes.CDLL(None, use_errno=True).prctl(PR_SET_PDEATHSIG, signal.SIGKILL, 0, 0, 0)
    if os.getppid() != parent:
        sys.exit("the parent has already ended")
    os.execvp(program[0], program)


if __name__ == "__main__":
    main()
