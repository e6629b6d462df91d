"""How a student's program is started: in a sandbox or, where there are no namespaces, without."""

from __future__ import annotations

import json
import os
import resource
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from contextlib import ExitStack, suppress
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath

from autograder.isolation.arena_spec import ISOLATION_VARIABLE, Kind
from autograder.isolation.bubblewrap import BUILD_FILTER, STUDENT_FILTER, Sandbox, same_paths
from autograder.isolation.limits import StudentLimits
from autograder.isolation.running_program import RunningProgram
from autograder.isolation.seccomp_filter import build_filter, student_filter

NICE_INCREMENT = (
    5  # added to the parent's nice value: robot and grader get about three times the processor time
)
OOM_SCORE = 500  # oom_score_adj, at most 1000: out of memory, the kernel ends students' programs first
_WORKDIR = "/tmp/work"  # the program's working directory in its sandbox
_NETWORK_VARIABLES = ("ROS_DOMAIN_ID", "FASTRTPS_DEFAULT_PROFILES_FILE", "FASTDDS_BUILTIN_TRANSPORTS")


@dataclass(frozen=True)
class Program:
    """What to run.

    Attributes:
        arguments: of Python: a file or `-m MODULE`, and its own arguments.
        workdir_files: content of the files in its fresh, writable working folder, by relative name.
        env: its environment, to which the arena's network settings are added.
        read_only_paths: files and folders of the arena that it may read, at the same path.
        limits: what it and everything it starts may use.
        builds: it is a module of the grader that runs CMake, which needs SIGCHLD handlers.

    Raises:
        ValueError: a file name leads out of the working folder.
    """

    arguments: Sequence[str]
    workdir_files: Mapping[str, bytes]
    env: Mapping[str, str] = field(default_factory=dict)
    read_only_paths: Sequence[str | Path] = ()
    limits: StudentLimits = field(default_factory=StudentLimits)
    builds: bool = False

    def __post_init__(self) -> None:
        for name in self.workdir_files:
            if PurePosixPath(name).is_absolute() or ".." in PurePosixPath(name).parts:
                raise ValueError(
                    f"the file name {name!r} leads out of the working directory; give a relative one without '..'"
                )


def start_program(program: Program, stack: ExitStack) -> RunningProgram:
    """Start the program as this arena allows. `stack` releases, after the end, what the start needed."""
    if (kind := os.environ.get(ISOLATION_VARIABLE)) != Kind.NAMESPACES:
        return _start_bare(program, stack, as_lone_user=kind == Kind.ANOTHER_USER)
    return _start_in_sandbox(program, stack)


def lower_priority(pid: int) -> None:
    """Lower the priority of a process and its future children, for processors and for memory."""
    os.sched_setscheduler(pid, os.SCHED_BATCH, os.sched_param(0))  # does not preempt others when it wakes up
    os.setpriority(os.PRIO_PROCESS, pid, min(19, os.getpriority(os.PRIO_PROCESS, pid) + NICE_INCREMENT))
    with open(f"/proc/{pid}/oom_score_adj", "r+") as score:
        wanted = max(int(score.read()), OOM_SCORE)
        score.seek(0)
        score.write(str(wanted))


def _environment(env: Mapping[str, str], home: str) -> dict[str, str]:
    """Return a program's whole environment, with what this arena's network needs."""
    ours = {
        "PATH": "/usr/bin:/bin",
        "LANG": "C.UTF-8",
        "HOME": home,
        "TMPDIR": "/tmp",
        "PYTHONUNBUFFERED": "1",  # so that each line can be timed
    }
    network = {name: os.environ[name] for name in _NETWORK_VARIABLES if name in os.environ}
    return {**ours, **env, **network}


def _start_in_sandbox(program: Program, stack: ExitStack) -> RunningProgram:
    with Sandbox() as sandbox:
        _describe(sandbox, program)
        sandbox.add_environment(_environment(program.env, _WORKDIR))
        # counted in this sandbox alone, as it has its own users
        nproc = f"--nproc={program.limits.processes}"
        limited = [*_limited(program.limits), nproc, "--", sys.executable, *program.arguments]
        # the command is no group leader, so setsid need not fork
        started = sandbox.start(["/usr/bin/setsid", "--", *limited], prepare=lower_priority)
    stack.callback(os.close, started.init_pidfd)
    return RunningProgram(started.process, started.command_pid, started.init_pid)


def _describe(sandbox: Sandbox, program: Program) -> None:
    limits = program.limits
    sandbox.add_isolation()
    sandbox.add("--disable-userns")
    sandbox.add_file_system(limits.tmp_mib, limits.shared_memory_mib, same_paths(program.read_only_paths))
    # a shared mapping of /dev/zero is memory that no limit counts; /dev/full also reads as zeros
    sandbox.add("--dev-bind", "/dev/full", "/dev/zero")
    # init runs as the program's user, so the program could otherwise write to init's memory
    sandbox.add("--perms", "0555", "--size", "4096", "--tmpfs", "/proc/1", "--remount-ro", "/proc/1")
    sandbox.add("--dir", _WORKDIR)
    for name, content in program.workdir_files.items():
        sandbox.add_data("--file", content, f"{_WORKDIR}/{name}")
    sandbox.close_file_system()
    sandbox.add("--chdir", _WORKDIR)
    sandbox.add_data("--seccomp", Path(BUILD_FILTER if program.builds else STUDENT_FILTER).read_bytes())


def _start_bare(program: Program, stack: ExitStack, as_lone_user: bool) -> RunningProgram:
    folder = Path(tempfile.mkdtemp(prefix="work-"))
    stack.callback(shutil.rmtree, folder, ignore_errors=True)
    for name, content in program.workdir_files.items():
        file = folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(content)
    as_user, filter_fds = _as_lone_user(program, folder, stack) if as_lone_user else ([], [])
    process = subprocess.Popen(
        [*as_user, *_limited(program.limits), "--", sys.executable, *program.arguments],
        pass_fds=filter_fds,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        bufsize=0,
        cwd=folder,
        env=_environment(program.env, str(folder)),
        start_new_session=True,
    )
    with suppress(ProcessLookupError):  # it has ended already
        lower_priority(process.pid)
    return RunningProgram(process, process.pid)


def _as_lone_user(program: Program, folder: Path, stack: ExitStack) -> tuple[list[str], list[int]]:
    """Return a command that drops root's privileges and executes the command after it, and the descriptor it reads."""
    descriptor = os.memfd_create("filter")
    stack.callback(os.close, descriptor)
    os.write(descriptor, build_filter() if program.builds else student_filter())
    plan = {
        "parent": os.getpid(),
        "folder": str(folder),
        "filter": descriptor,
        "processes": program.limits.processes,
    }
    script = Path(__file__).with_name("lone_user.py")
    return [sys.executable, "-I", "-S", str(script), json.dumps(plan)], [descriptor]


def _limited(limits: StudentLimits) -> list[str]:
    """Return a command that sets the limits of a process and executes the command after it."""
    of_each_process = {
        "nofile": limits.open_files,
        "fsize": limits.file_mib * 2**20,
        "as": limits.address_space_mib * 2**20,
        "core": 0,
    }
    options = (f"--{name}={_within_hard(name, value)}" for name, value in of_each_process.items())
    return ["/usr/bin/prlimit", *options]


def _within_hard(name: str, value: int) -> int:
    """Return the limit, or the machine's hard limit if that is lower, which only root may raise."""
    _, hard = resource.getrlimit(getattr(resource, f"RLIMIT_{name.upper()}"))
    return value if hard == resource.RLIM_INFINITY else min(value, hard)
