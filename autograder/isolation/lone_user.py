"""Runs a program as a new user, with the student's limits and filter, where namespaces are unavailable. Needs root.

Root in a container, as on Gradescope, can neither create namespaces nor mount. There a student's program runs as a
user who owns only its working folder: it cannot write root's files, signal or trace root's processes, or change its
user again. It shares network, process list and /tmp with the grader, so it must not be graded with hidden checks.

Run as `python -I -S lone_user.py PLAN PROGRAM ARGUMENTS…`, where PLAN is JSON: the id of the process that starts it
("parent"), its working folder ("folder"), a descriptor with the system call filter ("filter") and the most processes
it may have ("processes"). The program must not be found by PATH.
"""

from __future__ import annotations

import ctypes
import json
import os
import resource
import sys

sys.path.append(os.path.abspath(f"{__file__}/../../.."))  # the project, which -I leaves out
from autograder.isolation.as_another_user import unused_id
from ros_runtime.workarounds.die_with_parent import die_with_parent

_PR_SET_NO_NEW_PRIVS, _PR_SET_SECCOMP, _SECCOMP_MODE_FILTER = 38, 22, 2
_INSTRUCTION = 8  # bytes of one instruction of a filter
_MOST_FILTER_BYTES = 8 * 4096  # the kernel's limit

_libc = ctypes.CDLL(None, use_errno=True)


class _FilterProgram(ctypes.Structure):
    """The kernel's struct sock_fprog."""

    _fields_ = (("length", ctypes.c_ushort), ("instructions", ctypes.c_char_p))


def main() -> None:
    """Give the folder to the new user, become that user, and exec the program."""
    plan = json.loads(sys.argv[1])
    instructions = os.pread(plan["filter"], _MOST_FILTER_BYTES, 0)
    os.close(plan["filter"])
    try:
        _drop_privileges(plan["folder"], plan["processes"], instructions)
    except OSError as error:
        sys.exit(f"root could not drop its privileges: {error}")
    if not die_with_parent(plan["parent"]):
        sys.exit("the process that started this program has ended")
    os.execv(sys.argv[2], sys.argv[2:])


def _drop_privileges(folder: str, processes: int, instructions: bytes) -> None:
    user = unused_id()
    os.chmod(folder, 0o700)
    for place, folders, names in os.walk(folder):
        for name in (*folders, *names):
            os.chown(os.path.join(place, name), user, user, follow_symlinks=False)
    os.chown(folder, user, user)
    os.setgroups([])
    os.setresgid(user, user, user)
    os.setresuid(user, user, user)
    # counted per user; no other program has this one
    resource.setrlimit(resource.RLIMIT_NPROC, (processes, processes))
    install_filter(instructions)


def install_filter(instructions: bytes) -> None:
    """Filter the system calls of this process and its future children, which can never get other privileges."""
    _prctl(_PR_SET_NO_NEW_PRIVS, 1)
    program = _FilterProgram(len(instructions) // _INSTRUCTION, instructions)
    _prctl(_PR_SET_SECCOMP, _SECCOMP_MODE_FILTER, ctypes.byref(program))


def _prctl(option: int, value: int, more: object = 0) -> None:
    if _libc.prctl(option, value, more, 0, 0) != 0:
        number = ctypes.get_errno()
        raise OSError(number, f"prctl({option}): {os.strerror(number)}")


if __name__ == "__main__":
    main()
