"""The system calls a student's process has no business with.

The namespaces already bound what these calls could reach; the filter keeps the kernel's less travelled code
out of reach too, and the memory that no limit counts. Everything else is allowed, so that ordinary programs
and their libraries run.
"""

from __future__ import annotations

import errno
import tempfile
from functools import lru_cache

from autograder.isolation.bubblewrap import SandboxError

_DENIED = (
    "ptrace", "process_vm_readv", "process_vm_writev", "process_madvise", "kcmp", "pidfd_getfd",
    "personality",
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
    "memfd_create", "memfd_secret", "shmget", "msgget", "semget",
)  # fmt: skip
_NETLINK = 16  # allowed, because it lists the network interfaces; unix, IPv4 and IPv6 are allowed too
_OLD_SOCKET_FAMILIES = (0, *range(3, 10), *range(11, 16))
_CLONE_NEW_NAMESPACES = (0x00020000, 0x02000000, 0x04000000, 0x08000000, 0x10000000, 0x20000000, 0x40000000)


class SeccompUnavailableError(SandboxError):
    """The system library that builds the filter is missing."""


@lru_cache(maxsize=1)
def student_filter() -> bytes:
    """Return the filter as a program for bwrap's --seccomp. Raises `SeccompUnavailableError`."""
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
    for flag in _CLONE_NEW_NAMESPACES:
        rules.add_rule(denied, "clone", pyseccomp.Arg(0, pyseccomp.MASKED_EQ, flag, flag))
    # a virtual machine's AF_VSOCK reaches its host from any network namespace
    for family in _OLD_SOCKET_FAMILIES:
        rules.add_rule(denied, "socket", pyseccomp.Arg(0, pyseccomp.EQ, family))
    rules.add_rule(denied, "socket", pyseccomp.Arg(0, pyseccomp.GT, _NETLINK))
    with tempfile.TemporaryFile() as program:
        rules.export_bpf(program)
        program.seek(0)
        return program.read()
