"""How an arena is started: with namespaces, as an ordinary user or as root, and without."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

from autograder.isolation.arena_spec import ISOLATION_VARIABLE, ArenaSpec, Kind
from autograder.isolation.bubblewrap import (
    BUILD_FILTER,
    STUDENT_FILTER,
    Sandbox,
    SandboxError,
    StartedSandbox,
    same_paths,
)
from autograder.isolation.memory_group import MemoryGroup, make_memory_group
from autograder.isolation.process_tree import ended_within
from autograder.isolation.seccomp_filter import build_filter, student_filter
from ros_runtime.project import PROJECT
from ros_runtime.ros_domain import NoDomainLeft, ReservedDomain

# Nodes prefer shared memory, but it does not work between two sandboxes or two users.
_UDP_ONLY = {"FASTDDS_BUILTIN_TRANSPORTS": "UDPv4"}
_END_TIMEOUT = 10.0  # s for the kernel, or the reaper, to end every process


class RunningArena:
    """The processes of a started arena, as the watching thread needs to see them."""

    def __init__(
        self,
        process: subprocess.Popen[bytes],
        root_pid: int,
        end_pidfd: int,
        under_reaper: bool,
        memory_group: MemoryGroup | None = None,
    ) -> None:
        self.process = process  # the child process that the controller has to wait for
        self.memory_group = memory_group  # of all processes
        self.root_pid = root_pid  # root of the arena's process tree
        self.end_pidfd = end_pidfd  # readable when the root has ended, and with it everything below
        self._under_reaper = under_reaper

    def end(self) -> bool:
        """End every process; True when it is certain that they are gone."""
        if self._under_reaper:  # the reaper ends its tree on SIGTERM; SIGKILL would leave orphans
            self.process.terminate()
        else:
            with suppress(ProcessLookupError):
                signal.pidfd_send_signal(self.end_pidfd, signal.SIGKILL)
        return self.has_ended()

    def has_ended(self) -> bool:
        """Wait until every process has ended; return False if that is not certain."""
        if not ended_within(self.end_pidfd, _END_TIMEOUT):
            self.process.kill()
            return False
        # a reaper that was killed may have left orphans
        return not self._under_reaper or self.process.wait() >= 0


def start_with_namespaces(spec: ArenaSpec, stack: ExitStack) -> RunningArena:
    """Start the arena in a sandbox; `stack` releases, after the end, what the start needed."""
    paths = same_paths(spec.read_only_paths)
    memory_group = make_memory_group(spec.limits.most_memory_mib)
    if memory_group:
        stack.callback(memory_group.remove)
    with Sandbox() as sandbox:
        if os.geteuid() == 0:
            with _staging_folder() as staging:
                _describe(
                    sandbox, spec, [(f"{staging}/{number}", path) for number, (_, path) in enumerate(paths)]
                )
                prefix = _as_another_user([source for source, _ in paths], staging)
                started = _start(sandbox, spec, memory_group, prefix)
        else:
            _describe(sandbox, spec, paths)
            started = _start(sandbox, spec, memory_group)
    stack.callback(os.close, started.init_pidfd)
    _write_stdin(started.process, spec.stdin)
    return RunningArena(
        started.process, started.init_pid, started.init_pidfd, under_reaper=False, memory_group=memory_group
    )


def start_without_namespaces(spec: ArenaSpec, stack: ExitStack, kind: Kind = Kind.NONE) -> RunningArena:
    """Start the arena as ordinary processes under a reaper, on a ROS domain of its own."""
    folder = Path(tempfile.mkdtemp(prefix=f"arena-{os.getpid()}-"))
    stack.callback(shutil.rmtree, folder, ignore_errors=True)
    try:
        domain = ReservedDomain()
    except NoDomainLeft as error:
        raise SandboxError(f"{error}: run fewer arenas at once") from error
    stack.callback(domain.release)
    network = {"ROS_DOMAIN_ID": str(domain.domain_id)}
    if kind is Kind.ANOTHER_USER:
        folder.chmod(0o711)  # the student's folder lies in it
        network |= _UDP_ONLY
    ready, tell = os.pipe()
    reaper = [sys.executable, "-S", "-E", "-m", "autograder.isolation.reaper", str(os.getpid()), str(tell)]
    try:
        process = subprocess.Popen(
            [*reaper, str(folder), *spec.command],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            pass_fds=(*spec.pass_fds, tell),
            env=_environment(spec, kind, str(folder), network),
            cwd=PROJECT,
        )
    finally:
        os.close(tell)
    with open(ready, "rb") as said:
        if not said.read():
            raise SandboxError(f"the arena's reaper did not start: {process.communicate()[1].decode()}")
    pidfd = os.pidfd_open(process.pid)
    stack.callback(os.close, pidfd)
    _write_stdin(process, spec.stdin)
    return RunningArena(process, process.pid, pidfd, under_reaper=True)


def _describe(sandbox: Sandbox, spec: ArenaSpec, paths: list[tuple[str, str]]) -> None:
    sandbox.add_isolation()
    sandbox.add("--unshare-net")
    sandbox.add_file_system(spec.limits.tmp_mib, spec.limits.shared_memory_mib, paths)
    sandbox.add_data("--ro-bind-data", student_filter(), STUDENT_FILTER)
    sandbox.add_data("--ro-bind-data", build_filter(), BUILD_FILTER)
    sandbox.close_file_system()
    sandbox.add("--chdir", "/tmp")
    sandbox.add_environment(_environment(spec, Kind.NAMESPACES, "/tmp", _UDP_ONLY))


def _start(
    sandbox: Sandbox, spec: ArenaSpec, memory_group: MemoryGroup | None, prefix: Sequence[str] = ()
) -> StartedSandbox:
    def bound(pid: int) -> None:
        if memory_group:
            with suppress(OSError):  # in some containers root can create groups but not add processes
                memory_group.add(pid)

    return sandbox.start(spec.command, prefix=prefix, pass_fds=spec.pass_fds, prepare=bound)


@contextmanager
def _staging_folder() -> Iterator[Path]:
    """Yield a folder for mounts, which exist only in the arena's mount namespace and are needed only for its start."""
    staging = Path(tempfile.mkdtemp(prefix=f"arena-{os.getpid()}-", dir="/tmp"))
    try:
        yield staging
    finally:
        for link in staging.iterdir():
            link.unlink()
        staging.rmdir()


def _as_another_user(paths: list[str], staging: Path) -> list[str]:
    plan = json.dumps({"parent": os.getpid(), "staging": str(staging), "paths": paths})
    return [sys.executable, "-I", "-S", str(Path(__file__).with_name("as_another_user.py")), plan]


def _environment(spec: ArenaSpec, kind: Kind, home: str, network: Mapping[str, str]) -> dict[str, str]:
    """Return the command's whole environment: defaults, the spec's variables, and the arena's network settings."""
    path = {"PATH": "/usr/local/bin:/usr/bin:/bin", "LANG": "C.UTF-8"}
    return {**path, "HOME": home, "TMPDIR": home, **spec.env, **network, ISOLATION_VARIABLE: kind.value}


def _write_stdin(process: subprocess.Popen[bytes], content: bytes) -> None:
    """Write the command's input in a background thread."""

    def write() -> None:
        assert process.stdin
        left = content
        with suppress(BrokenPipeError), process.stdin:
            while left:
                left = left[process.stdin.write(left) :]

    threading.Thread(target=write, name="arena stdin", daemon=True).start()
