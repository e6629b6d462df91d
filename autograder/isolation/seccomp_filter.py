"""The filter of system calls for students' processes.

The namespaces already limit what these calls could reach. The filter also denies rarely used kernel code, memory and
processor time that escape the accounting, and calls that reveal which pages of a shared file another arena has read.
Everything else is allowed, so that ordinary programs and their libraries run.
"""

from __future__ import annotations

import errno
import signal
import socket
import tempfile
from functools import lru_cache

from autograder.isolation.bubblewrap import SandboxError

_DENIED = (
    "ptrace", "process_vm_readv", "process_vm_writev", "process_madvise", "process_mrelease", "kcmp",
    "pidfd_open", "pidfd_getfd", "pidfd_send_signal", "personality",
    "sched_setattr",
    "keyctl", "add_key", "request_key",
    "mount", "umount", "umount2", "pivot_root", "chroot", "move_mount", "open_tree", "fsopen", "fsconfig",
    "fsmount", "fspick", "mount_setattr",
    "setns", "unshare", "name_to_handle_at", "open_by_handle_at",
    "bpf", "perf_event_open", "userfaultfd", "fanotify_init", "io_uring_setup", "io_uring_enter",
    "io_uring_register",
    "init_module", "finit_module", "delete_module", "kexec_load", "kexec_file_load", "reboot", "swapon",
    "swapoff",
    "quotactl", "quotactl_fd", "acct", "syslog", "vhangup", "iopl", "ioperm", "modify_ldt",
    "lookup_dcookie", "uselib", "ustat", "sysfs", "nfsservctl",
    "settimeofday", "clock_settime", "clock_adjtime", "adjtimex", "sethostname", "setdomainname",
    "migrate_pages", "move_pages", "mbind", "set_mempolicy",
    "memfd_create", "memfd_secret", "shmget", "msgget", "semget", "mq_open",
    "landlock_create_ruleset", "landlock_add_rule", "landlock_restrict_self",
    "mincore",
)  # fmt: skip
# Numbered alike on every architecture: cachestat, statmount, listmount, open_tree_attr and what is still to come.
_NEWER_THAN_LIBRARIES_NEED = range(451, 512)
# allowed, because it lists the network interfaces, as unix, IPv4 and IPv6 are
_NETLINK, _NETLINK_ROUTE = 16, 0
_OLD_SOCKET_FAMILIES = (0, *range(3, 10), *range(11, 16))
_CLONE_NEW_NAMESPACES = (0x00020000, 0x02000000, 0x04000000, 0x08000000, 0x10000000, 0x20000000, 0x40000000)
_CLONE_PARENT = 0x00008000  # makes the child a sibling: it would leave the program's process tree
_MAP_KIND_OR_ANONYMOUS, _MAP_SHARED_ANONYMOUS = 0x2F, 0x21
_RWF_NOWAIT = 0x8
_POLICY, _BEFORE_OTHERS = 0xFF, (0, 1, 2, 6, 7)  # scheduling policies with priority over SCHED_BATCH


class SeccompUnavailableError(SandboxError):
    """The system library that builds the filter is missing."""


@lru_cache(maxsize=1)
def student_filter() -> bytes:
    """Return the filter of students' programs, as a program for bwrap's --seccomp.

    Raises:
        SeccompUnavailableError: the library is missing.
    """
    return _filter(handles_children=False)


@lru_cache(maxsize=1)
def build_filter() -> bytes:
    """Return the filter for the grader's modules that build students' definitions with CMake; see `student_filter`."""
    return _filter(handles_children=True)


def _filter(handles_children: bool) -> bytes:
    try:
        import pyseccomp
    except (ImportError, RuntimeError) as error:
        raise SeccompUnavailableError(f"no libseccomp ({error}): apt-get install libseccomp2") from error

    denied = pyseccomp.ERRNO(errno.EPERM)
    rules = pyseccomp.SyscallFilter(pyseccomp.ALLOW)
    for name in _DENIED:
        if pyseccomp.resolve_syscall(pyseccomp.Arch.NATIVE, name) >= 0:  # not on every architecture
            rules.add_rule(denied, name)
    # clone3 keeps its flags in memory, where no filter can look; without it the C library falls back to clone
    rules.add_rule(pyseccomp.ERRNO(errno.ENOSYS), "clone3")
    for number in _NEWER_THAN_LIBRARIES_NEED:
        rules.add_rule(pyseccomp.ERRNO(errno.ENOSYS), number)
    for flag in (*_CLONE_NEW_NAMESPACES, _CLONE_PARENT):
        rules.add_rule(denied, "clone", pyseccomp.Arg(0, pyseccomp.MASKED_EQ, flag, flag))
    # a virtual machine's AF_VSOCK reaches its host from any network namespace
    for family in _OLD_SOCKET_FAMILIES:
        rules.add_rule(denied, "socket", pyseccomp.Arg(0, pyseccomp.EQ, family))
    rules.add_rule(denied, "socket", pyseccomp.Arg(0, pyseccomp.GT, _NETLINK))
    rules.add_rule(
        denied,
        "socket",
        pyseccomp.Arg(0, pyseccomp.EQ, _NETLINK),
        pyseccomp.Arg(2, pyseccomp.NE, _NETLINK_ROUTE),
    )
    for policy in _BEFORE_OTHERS:  # the middleware sets its present policy again, which stays allowed
        rules.add_rule(denied, "sched_setscheduler", pyseccomp.Arg(1, pyseccomp.MASKED_EQ, _POLICY, policy))
    # report success without effect, as the kernel does above its maximum: buffers keep the default size
    for option in (socket.SO_SNDBUF, socket.SO_RCVBUF):
        rules.add_rule(
            pyseccomp.ERRNO(0),
            "setsockopt",
            pyseccomp.Arg(1, pyseccomp.EQ, int(socket.SOL_SOCKET)),
            pyseccomp.Arg(2, pyseccomp.EQ, int(option)),
        )
    # shared anonymous memory can stay allocated without being in any process's resident size
    rules.add_rule(
        pyseccomp.ERRNO(errno.ENOMEM),
        "mmap",
        pyseccomp.Arg(3, pyseccomp.MASKED_EQ, _MAP_KIND_OR_ANONYMOUS, _MAP_SHARED_ANONYMOUS),
    )
    if not handles_children:
        # the kernel counts a child's processor time when its parent waits for it; ignoring SIGCHLD would skip that
        rules.add_rule(
            denied,
            "rt_sigaction",
            pyseccomp.Arg(0, pyseccomp.EQ, int(signal.SIGCHLD)),
            pyseccomp.Arg(1, pyseccomp.NE, 0),
        )
    rules.add_rule(
        pyseccomp.ERRNO(errno.EOPNOTSUPP),
        "preadv2",
        pyseccomp.Arg(5, pyseccomp.MASKED_EQ, _RWF_NOWAIT, _RWF_NOWAIT),
    )
    with tempfile.TemporaryFile() as program:
        rules.export_bpf(program)
        program.seek(0)
        return program.read()
