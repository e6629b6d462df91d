"""Enters an existing sandbox and gives up every privilege that a program in it may not have."""

from __future__ import annotations

import ctypes
import os
import resource
from collections.abc import Mapping

_CLONE_NEWNS, _CLONE_NEWCGROUP, _CLONE_NEWUTS = 0x00020000, 0x02000000, 0x04000000
_CLONE_NEWIPC, _CLONE_NEWUSER, _CLONE_NEWPID = 0x08000000, 0x10000000, 0x20000000
_NAMESPACES = _CLONE_NEWNS | _CLONE_NEWCGROUP | _CLONE_NEWUTS | _CLONE_NEWIPC | _CLONE_NEWUSER | _CLONE_NEWPID
_PR_SET_DUMPABLE, _PR_SET_SECCOMP, _PR_CAPBSET_DROP = 4, 22, 24
_PR_SET_NO_NEW_PRIVS, _PR_CAP_AMBIENT, _PR_CAP_AMBIENT_CLEAR_ALL = 38, 47, 4
_SECCOMP_MODE_FILTER = 2
_CAPABILITY_VERSION_3 = 0x20080522
_LAST_POSSIBLE_CAPABILITY = 63
_INSTRUCTION_BYTES = 8  # of a seccomp filter
NICER = 5  # nice value above the parent's: robot and grader get about three times the processor time
OOM_SCORE = 500  # oom_score_adj, at most 1000: out of memory, the kernel ends students' programs first

_libc = ctypes.CDLL(None, use_errno=True)


class _FilterProgram(ctypes.Structure):
    _fields_ = (("length", ctypes.c_ushort), ("instructions", ctypes.c_char_p))


def join_namespaces(pid: int) -> None:
    """Enter all namespaces of a process except its network; the PID namespace applies from the next fork on.

    Raises:
        OSError: the kernel does not permit it; this process must have a single thread.
    """
    target = os.pidfd_open(pid)
    try:
        _check(_libc.setns(target, _NAMESPACES), "setns")
    finally:
        os.close(target)


def stand_back(pid: int) -> None:
    """Lower the priority of a process (0: this one) and its future children, for processors and for memory."""
    os.sched_setscheduler(pid, os.SCHED_BATCH, os.sched_param(0))  # does not preempt others when it wakes up
    os.setpriority(os.PRIO_PROCESS, pid, min(19, os.getpriority(os.PRIO_PROCESS, pid) + NICER))
    with open(f"/proc/{pid or 'self'}/oom_score_adj", "r+") as score:
        wanted = max(int(score.read()), OOM_SCORE)
        score.seek(0)
        score.write(str(wanted))


def give_up_privileges(limits: Mapping[str, int], seccomp_filter: bytes) -> None:
    """Set limits (by the names of `resource`), drop every capability for good, and install the filter."""
    for name, value in limits.items():
        kind = getattr(resource, f"RLIMIT_{name.upper()}")
        _, hard = resource.getrlimit(kind)
        value = value if hard == resource.RLIM_INFINITY else min(value, hard)
        resource.setrlimit(kind, (value, value))
    _prctl(_PR_SET_NO_NEW_PRIVS, 1)
    for capability in range(_LAST_POSSIBLE_CAPABILITY + 1):
        if _libc.prctl(_PR_CAPBSET_DROP, capability, 0, 0, 0) != 0:
            break  # the kernel has no more capabilities
    _prctl(_PR_CAP_AMBIENT, _PR_CAP_AMBIENT_CLEAR_ALL)
    header = (ctypes.c_uint32 * 2)(_CAPABILITY_VERSION_3, 0)
    _check(_libc.capset(header, (ctypes.c_uint32 * 6)()), "capset")
    _prctl(_PR_SET_DUMPABLE, 1)  # as after every exec: a program may read about itself in /proc
    stand_back(0)
    program = _FilterProgram(len(seccomp_filter) // _INSTRUCTION_BYTES, seccomp_filter)
    _prctl(_PR_SET_SECCOMP, _SECCOMP_MODE_FILTER, ctypes.addressof(program))


def _prctl(option: int, *arguments: int) -> None:
    wide = [ctypes.c_ulong(argument) for argument in (*arguments, 0, 0, 0, 0)[:4]]
    _check(_libc.prctl(option, *wide), f"prctl {option}")


def _check(result: int, what: str) -> None:
    if result != 0:
        number = ctypes.get_errno()
        raise OSError(number, f"{what}: {os.strerror(number)}")
