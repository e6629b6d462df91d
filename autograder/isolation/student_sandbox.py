"""How a student's program is started: in a sandbox, or, where there are no namespaces, without."""

from __future__ import annotations

import os
import resource
import shutil
import signal
import subprocess
import tempfile
import threading
from collections.abc import Mapping, Sequence
from contextlib import ExitStack, suppress
from dataclasses import dataclass
from pathlib import Path

from autograder.isolation.arena_spec import ISOLATION_VARIABLE, Kind
from autograder.isolation.bubblewrap import STUDENT_FILTER, Sandbox, same_paths
from autograder.isolation.limits import StudentLimits
from autograder.isolation.process_tree import descendants

_WORKDIR = "/tmp/work"  # the program's working directory in its sandbox
_NETWORK_VARIABLES = ("ROS_DOMAIN_ID", "FASTRTPS_DEFAULT_PROFILES_FILE", "FASTDDS_BUILTIN_TRANSPORTS")


@dataclass(frozen=True)
class Program:
    """What to run; see :func:`.student_process.start_student`."""

    argv: Sequence[str]
    workdir_files: Mapping[str, bytes]
    env: Mapping[str, str]
    read_only_paths: Sequence[str | Path]
    limits: StudentLimits


def start_program(program: Program, stack: ExitStack) -> RunningProgram:
    """Start the program as this arena allows. `stack` releases, after the end, what the start needed."""
    if os.environ.get(ISOLATION_VARIABLE) == Kind.NAMESPACES:
        return _start_in_sandbox(program, stack)
    return _start_bare(program, stack)


class RunningProgram:
    """The started program, as seen from the arena. Its process ids are not used again once it is closed."""

    def __init__(self, process: subprocess.Popen[bytes], main_pid: int, init_pid: int | None = None) -> None:
        self.process = process
        self._main_pid = main_pid
        self._init_pid = init_pid  # of its sandbox, when it has one
        self._lock = threading.Lock()
        self.end_pidfd = os.pidfd_open(process.pid)

    def signal(self, number: signal.Signals) -> None:
        """Send a signal to the program alone."""
        with self._lock, suppress(ProcessLookupError):
            if self.end_pidfd >= 0:
                os.kill(self._main_pid, number)

    def end(self) -> None:
        """End the program and everything below it. Harmless when it has ended."""
        with self._lock:
            if self.end_pidfd < 0:
                return
            # with its init the kernel ends all of a sandbox
            below = [self._init_pid] if self._init_pid else descendants(self.process.pid)
            for pid in (*below, self.process.pid):
                with suppress(ProcessLookupError, PermissionError):
                    os.kill(pid, signal.SIGKILL)

    def close(self) -> int:
        """Wait for the end; returns the program's status, -n when signal n ended it."""
        self.end()
        with self._lock:
            os.close(self.end_pidfd)
            self.end_pidfd = -1
            status = self.process.wait()
        return 128 - status if self._init_pid and 128 < status <= 192 else status


def _start_in_sandbox(program: Program, stack: ExitStack) -> RunningProgram:
    limits = program.limits
    with Sandbox() as sandbox:
        sandbox.add_isolation()
        sandbox.add("--disable-userns")
        sandbox.add_file_system(limits.tmp_mib, limits.shared_memory_mib, same_paths(program.read_only_paths))
        sandbox.add("--dir", _WORKDIR)
        for name, content in program.workdir_files.items():
            sandbox.add_data("--file", content, f"{_WORKDIR}/{name}")
        sandbox.close_file_system()
        sandbox.add("--chdir", _WORKDIR)
        sandbox.add_data("--seccomp", Path(STUDENT_FILTER).read_bytes())
        sandbox.add_environment(_environment(program, _WORKDIR))
        nproc = f"--nproc={limits.processes}"  # counted in this sandbox alone, as it has its own users
        started = sandbox.start([*_limited(limits), nproc, "--", *program.argv])
    stack.callback(os.close, started.init_pidfd)
    return RunningProgram(started.process, started.command_pid, started.init_pid)


def _start_bare(program: Program, stack: ExitStack) -> RunningProgram:
    folder = Path(tempfile.mkdtemp(prefix="work-"))
    stack.callback(shutil.rmtree, folder, ignore_errors=True)
    for name, content in program.workdir_files.items():
        file = folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(content)
    process = subprocess.Popen(
        [*_limited(program.limits), "--", *program.argv],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        bufsize=0,
        cwd=folder,
        env=_environment(program, str(folder)),
        start_new_session=True,
    )
    return RunningProgram(process, process.pid)


def _limited(limits: StudentLimits) -> list[str]:
    """Return the command that sets the limits of a process and then becomes the program."""
    wanted = {
        "nofile": (resource.RLIMIT_NOFILE, limits.open_files),
        "fsize": (resource.RLIMIT_FSIZE, limits.file_mib * 2**20),
        "as": (resource.RLIMIT_AS, limits.address_space_mib * 2**20),
        "core": (resource.RLIMIT_CORE, 0),
    }
    return [
        "/usr/bin/prlimit",
        *(f"--{name}={_within_hard(kind, value)}" for name, (kind, value) in wanted.items()),
    ]


def _within_hard(kind: int, value: int) -> int:
    """Return the limit, or what the machine allows when that is less: nobody but root may raise it."""
    _, hard = resource.getrlimit(kind)
    return value if hard == resource.RLIM_INFINITY else min(value, hard)


def _environment(program: Program, home: str) -> dict[str, str]:
    """Return the program's whole environment. Its output must arrive line by line to be timed."""
    ours = {
        "PATH": "/usr/bin:/bin",
        "LANG": "C.UTF-8",
        "HOME": home,
        "TMPDIR": "/tmp",
        "PYTHONUNBUFFERED": "1",
    }
    network = {name: os.environ[name] for name in _NETWORK_VARIABLES if name in os.environ}
    return {**ours, **program.env, **network}
