"""One bubblewrap sandbox: what its file system shows, and how it starts so that its init process is known.

The arguments go through a file in memory instead of the command line, because a process inside can read the
command line of its init process, and with it the paths of the host.
"""

from __future__ import annotations

import json
import os
import select
import subprocess
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from autograder.isolation.process_tree import children, ended_within, is_asleep

WRITABLE = ("/tmp", "/dev/shm")  # each sandbox's own in-memory file systems
# where the arena keeps the filters of `seccomp_filter`
STUDENT_FILTER, BUILD_FILTER = "/run/course/student.seccomp", "/run/course/build.seccomp"

_START_TIMEOUT = 30.0  # s, for the namespaces and mounts on a busy machine
# The command waits for "go", which is sent once init is bound to bwrap. If this process dies earlier, stdin ends and
# the shell exits.
_WAIT_FOR_GO = ("/bin/sh", "-c", 'read -r go && exec "$@"', "sh")
_UID = 1000  # the same in every sandbox, whatever the user outside
_ETC = {
    "/etc/passwd": f"user:x:{_UID}:{_UID}::/tmp:/bin/sh\n",
    "/etc/group": f"user:x:{_UID}:\n",
    "/etc/hosts": "127.0.0.1 localhost arena\n",
    "/etc/nsswitch.conf": "passwd: files\ngroup: files\nhosts: files\n",
}
_PROGRAM_FOLDERS = ("/usr/bin", "/usr/local/bin", "/bin")
_SYSTEM_LINKS = ("/bin", "/sbin", "/lib", "/lib32", "/lib64", "/libx32")
_SYSTEM_FILES = ("/etc/ld.so.cache", "/etc/alternatives", "/etc/localtime")
SYSTEM_PATHS = ("/usr", *_SYSTEM_LINKS, *_SYSTEM_FILES)  # of the host, shown in every sandbox


class SandboxError(Exception):
    """A sandbox could not be started; the submission is never the cause."""


@dataclass(frozen=True)
class StartedSandbox:
    """A running sandbox. When `init_pidfd` becomes readable, the kernel has ended every process inside."""

    process: subprocess.Popen[bytes]  # bwrap: ends with the command's status, or 128 + n after signal n
    init_pid: int
    init_pidfd: int
    command_pid: int


class Sandbox:
    """Builds the arguments of a bwrap call; a context manager, because it owns the memory files that hold them."""

    def __init__(self) -> None:
        self._arguments: list[str] = []
        self._fds: list[int] = []

    def __enter__(self) -> Sandbox:
        return self

    def __exit__(self, *_: object) -> None:
        for fd in self._fds:
            os.close(fd)
        self._fds.clear()

    def add(self, *arguments: str) -> None:
        """Add arguments as they are."""
        self._arguments += arguments

    def add_data(self, option: str, content: bytes, *after: str) -> None:
        """Add an option that reads `content` from a descriptor: --file, --ro-bind-data, --seccomp."""
        self.add(option, str(self._hold(content)), *after)

    def add_isolation(self) -> None:
        """Give it namespaces for users, processes, IPC and names, and no capabilities; it ends with its parent."""
        self.add("--unshare-user", "--uid", str(_UID), "--gid", str(_UID))
        self.add(
            "--unshare-pid", "--unshare-ipc", "--unshare-uts", "--hostname", "arena", "--unshare-cgroup-try"
        )
        self.add("--die-with-parent", "--new-session", "--cap-drop", "ALL", "--clearenv")

    def add_file_system(
        self, tmp_mib: int, shared_memory_mib: int, read_only: Iterable[tuple[str, str]]
    ) -> None:
        """Show the system's programs, a limited /tmp and /dev/shm, and read-only paths (source, path inside)."""
        self.add("--proc", "/proc", "--dev", "/dev")
        self.add("--perms", "1777", "--size", str(shared_memory_mib * 2**20), "--tmpfs", "/dev/shm")
        self.add("--perms", "1777", "--size", str(tmp_mib * 2**20), "--tmpfs", "/tmp")
        self.add("--ro-bind", "/usr", "/usr")
        for path in _SYSTEM_LINKS:
            if os.path.islink(path):
                self.add("--symlink", os.readlink(path), path)
            elif os.path.isdir(path):
                self.add("--ro-bind", path, path)
        for path in _SYSTEM_FILES:
            self.add("--ro-bind-try", path, path)
        for path, text in _ETC.items():
            self.add_data("--ro-bind-data", text.encode(), path)
        for source, path in read_only:
            self.add("--ro-bind", source, path)

    def close_file_system(self) -> None:
        """Remount / and /dev read-only: they are in-memory file systems without a size limit."""
        self.add("--remount-ro", "/dev", "--remount-ro", "/")

    def add_environment(self, env: Mapping[str, str]) -> None:
        """Set the variables of the command, which inherits none."""
        for name, value in env.items():
            self.add("--setenv", name, value)

    def start(
        self,
        command: Sequence[str],
        *,
        prefix: Sequence[str] = (),
        pass_fds: Sequence[int] = (),
        prepare: Callable[[int], object] = lambda pid: None,
    ) -> StartedSandbox:
        """Run `command` inside with pipes for its streams; `prefix` is a program that becomes bwrap.

        `prepare` gets the process id that the command will have, before it runs.

        Call it from a thread that lives as long as the sandbox: the kernel ends the sandbox when that thread
        ends. Raises `SandboxError` when the command could not be started.
        """
        started = self._start(command, prefix, pass_fds)
        assert started.process.stdin
        try:
            prepare(started.command_pid)
            started.process.stdin.write(b"go\n")
        except OSError as error:
            raise SandboxError(_why_it_failed(started.process)) from error
        return started

    def _start(
        self, command: Sequence[str], prefix: Sequence[str], pass_fds: Sequence[int]
    ) -> StartedSandbox:
        info, tell = os.pipe()
        self.add("--info-fd", str(tell))
        arguments = self._hold("\0".join(self._arguments).encode() + b"\0")
        try:
            process = subprocess.Popen(
                [*prefix, bwrap_path(), "--args", str(arguments), "--", *_WAIT_FOR_GO, *command],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                bufsize=0,
                pass_fds=(*pass_fds, *self._fds, tell),
                env={},  # bwrap itself needs none, and ours may preload libraries
            )
        finally:
            os.close(tell)
        try:
            return _when_ready(process, info)
        except OSError as error:
            raise SandboxError(_why_it_failed(process)) from error
        finally:
            os.close(info)

    def _hold(self, content: bytes) -> int:
        fd = os.memfd_create("sandbox")
        self._fds.append(fd)
        os.write(fd, content)
        os.lseek(fd, 0, os.SEEK_SET)
        return fd


def bwrap_path() -> str:
    """Return the path of bubblewrap in a system folder; PATH is not used, because anyone can change it."""
    for folder in _PROGRAM_FOLDERS:
        if os.access(path := f"{folder}/bwrap", os.X_OK):
            return path
    raise SandboxError("bubblewrap is not installed: apt-get install bubblewrap")


def same_paths(paths: Iterable[str | Path]) -> list[tuple[str, str]]:
    """Return for each path the pair (source, path inside), which are the same; a missing one raises `SandboxError`."""
    pairs = []
    for path in dict.fromkeys(os.path.abspath(path) for path in paths):
        if not os.path.exists(path):
            raise SandboxError(f"{path} is to be shown in a sandbox, but it does not exist")
        pairs.append((path, path))
    return sorted(pairs)  # a folder comes before what lies in it


def _when_ready(process: subprocess.Popen[bytes], info: int) -> StartedSandbox:
    """Return when it is certain that the sandbox's init ends with this process. Raises OSError when that fails."""
    deadline = time.monotonic() + _START_TIMEOUT
    init_pid = _read_init_pid(info)
    init_pidfd = os.pidfd_open(init_pid)
    try:
        while not ((found := children(init_pid)) and is_asleep(init_pid)):  # init waits for the command
            if ended_within(init_pidfd, 0.001):
                raise ProcessLookupError("the sandbox ended before its command could run")
            if time.monotonic() > deadline:
                raise TimeoutError("the sandbox was not ready in time")
    except OSError:
        os.close(init_pidfd)
        raise
    return StartedSandbox(process, init_pid, init_pidfd, found[0])


def _read_init_pid(fd: int) -> int:
    poll = select.poll()
    poll.register(fd, select.POLLIN)
    received = b""
    while b"}" not in received:
        data = os.read(fd, 4096) if poll.poll(_START_TIMEOUT * 1000) else b""
        if not data:
            raise ProcessLookupError("bubblewrap did not name its init process")
        received += data
    return int(json.loads(received)["child-pid"])


def _why_it_failed(process: subprocess.Popen[bytes]) -> str:
    process.kill()
    _, complaint = process.communicate()
    said = complaint.decode(errors="replace").strip() or "nothing"
    return f"bubblewrap ended with status {process.returncode} before the command ran; it said: {said}"
