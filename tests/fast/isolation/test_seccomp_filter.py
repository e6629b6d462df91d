"""The system calls that the filter refuses and allows, tested by a process that has installed it."""

from __future__ import annotations

import errno
import subprocess
import sys

import pyseccomp
import pytest

from autograder.isolation.seccomp_filter import student_filter
from ros_runtime.project import PROJECT

CONFINED = """
import ctypes, errno, mmap, os, signal, socket, sys
from autograder.isolation.lone_user import install_filter
from autograder.isolation.student_sandbox import lower_priority
lower_priority(os.getpid())
install_filter(sys.stdin.buffer.read())
libc = ctypes.CDLL(None, use_errno=True)
def call(number, *arguments):
    result = libc.syscall(ctypes.c_long(number), *map(ctypes.c_long, arguments))
    if result < 0:
        raise OSError(ctypes.get_errno(), "refused")
NUMBERS = dict(zip(("mincore", "mq_open"), map(int, sys.argv[2:])))
try:
    exec(sys.argv[1])
    print(0)
except OSError as error:
    print(error.errno)
"""

REFUSED = {
    "netlink for anything but routes": ("socket.socket(16, socket.SOCK_RAW, 12)", errno.EPERM),
    "audit's netlink": ("socket.socket(16, socket.SOCK_DGRAM, 9)", errno.EPERM),
    "xfrm's netlink": ("socket.socket(16, socket.SOCK_RAW | socket.SOCK_CLOEXEC, 6)", errno.EPERM),
    "shared memory without a file": ("mmap.mmap(-1, 4096)", errno.ENOMEM),
    "shared memory without a file, populated": (
        "mmap.mmap(-1, 4096, flags=mmap.MAP_SHARED | mmap.MAP_ANONYMOUS | 0x8000)",
        errno.ENOMEM,
    ),
    "children that nobody waits for": ("signal.signal(signal.SIGCHLD, signal.SIG_IGN)", errno.EPERM),
    "whether a page is in memory": (
        "preadv2 = os.preadv(os.open(sys.executable, 0), [bytearray(1)], 0, os.RWF_NOWAIT)",
        errno.EOPNOTSUPP,
    ),
    "a scheduling class of its own": (
        "os.sched_setscheduler(0, os.SCHED_OTHER, os.sched_param(0))",
        errno.EPERM,
    ),
    "a descriptor of a process": ("os.pidfd_open(os.getpid())", errno.EPERM),
    "which pages of a mapping are in memory": ("call(NUMBERS['mincore'], 0, 0, 0)", errno.EPERM),
    "a queue of messages": ("call(NUMBERS['mq_open'], 0, 0, 0, 0)", errno.EPERM),
    "the list of mounts": ("call(458, 0, 0, 0, 0)", errno.ENOSYS),
    "what is known of a mount": ("call(457, 0, 0, 0, 0)", errno.ENOSYS),
    "how much of a file is in memory": ("call(451, 0, 0, 0, 0)", errno.ENOSYS),
    "a mounted tree": ("call(467, 0, 0, 0, 0, 0)", errno.ENOSYS),
}
ALLOWED = {
    "the scheduling class it has": "os.sched_setscheduler(0, os.SCHED_BATCH, os.sched_param(0))",
    "the network interfaces": "assert socket.if_nameindex()",
    "netlink for routes": "socket.socket(16, socket.SOCK_RAW, 0)",
    "shared memory with a file": """
import tempfile
with tempfile.TemporaryFile() as file:
    file.truncate(4096)
    mmap.mmap(file.fileno(), 4096)
""",
    "private memory without a file": "mmap.mmap(-1, 4096, flags=mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS)",
    "reading": "assert os.preadv(os.open(sys.executable, 0), [bytearray(1)], 0) == 1",
    "asking for a handler": "signal.getsignal(signal.SIGCHLD)",
    "a handler of another signal": "signal.signal(signal.SIGUSR1, signal.SIG_IGN)",
    "threads": """
import threading
thread = threading.Thread(target=print, args=('',), kwargs={'end': ''})
thread.start()
thread.join()
""",
    "a program that is waited for": "import os; assert os.system('/bin/true | /bin/true') == 0",
    "a process of multiprocessing": """
import multiprocessing
process = multiprocessing.get_context('fork').Process(target=os.getpid)
process.start()
process.join()
assert process.exitcode == 0
""",
    "a value of multiprocessing": "import multiprocessing; multiprocessing.Value('i', 3)",
    "a program of asyncio": """
import asyncio
async def run():
    process = await asyncio.create_subprocess_exec('/bin/true')
    assert await process.wait() == 0
asyncio.run(run())
""",
}


def errno_of(code: str) -> int:
    """Return the errno that the code gets under the filter; 0 without an error."""
    numbers = [str(pyseccomp.resolve_syscall(pyseccomp.Arch.NATIVE, name)) for name in ("mincore", "mq_open")]
    done = subprocess.run(
        [sys.executable, "-c", CONFINED, code, *numbers],
        input=student_filter(),
        capture_output=True,
        cwd=PROJECT,
        check=False,
    )
    assert done.returncode == 0, done.stderr.decode()
    return int(done.stdout)


@pytest.mark.parametrize(("code", "error"), REFUSED.values(), ids=REFUSED)
def test_it_refuses(code: str, error: int) -> None:
    assert errno.errorcode[errno_of(code)] == errno.errorcode[error]


@pytest.mark.parametrize("code", ALLOWED.values(), ids=ALLOWED)
def test_it_lets_pass(code: str) -> None:
    assert errno_of(code) == 0


def test_a_buffer_of_a_socket_stays_as_the_system_has_it() -> None:
    code = """
one, _ = socket.socketpair()
before = one.getsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF)
one.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, 16 * before)
one.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
assert one.getsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF) == before
assert one.getsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR) == 1
"""
    assert errno_of(code) == 0
