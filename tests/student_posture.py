"""The security profile of a student's process: the promised one, and the actual one, read from /proc outside it.

`promise_table` makes the table in `docs/grading.md`; a test compares it with real processes.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path

from autograder.isolation.limits import StudentLimits
from autograder.isolation.student_sandbox import NICE_INCREMENT, OOM_SCORE

_CAPABILITIES = ("CapInh", "CapPrm", "CapEff", "CapBnd", "CapAmb")
_OWN = ("ipc", "mnt", "pid", "user", "uts")
_LIMITS = {
    "Max open files": 1,
    "Max file size": 2**20,
    "Max address space": 2**20,
    "Max core file size": 1,
    "Max processes": 1,
}
_ALLOWED = StudentLimits()

PROMISES: Mapping[str, tuple[str, str]] = {
    "capabilities": ("none", "it has no rights of root, not even in its own sandbox"),
    "new privileges": ("never", "setuid programs give it no additional rights"),
    "system calls": ("filtered", "`isolation/seccomp_filter.py` lists those that are blocked"),
    "own namespaces": (
        ", ".join(_OWN),
        "it sees no users, processes, files or shared memory of other programs or of the grader",
    ),
    "network": (
        "the arena's",
        "it has only the interface `lo`, on which only robot and grader communicate with it",
    ),
    "user": ("1000 alone", "it cannot use the id of any other user of the machine"),
    "writable": (
        f"/dev/shm {_ALLOWED.shared_memory_mib} MiB, /tmp {_ALLOWED.tmp_mib} MiB",
        f"both are deleted when it ends; they hold at most {_ALLOWED.files:,} files together",
    ),
    "setuid files": ("without effect", "every mount has the option `nosuid`"),
    "descriptors": ("3 pipes", "stdin, stdout and stderr; it inherits no other descriptors"),
    "limits": (
        f"{_ALLOWED.open_files} descriptors, files of {_ALLOWED.file_mib} MiB, {_ALLOWED.address_space_mib} MiB of "
        f"address space, no core file, {_ALLOWED.processes} processes",
        f"the grader also ends a program that uses more than {_ALLOWED.memory_mib} MiB of memory or "
        f"{_ALLOWED.sockets} sockets",
    ),
    "scheduling": (
        f"batch, nice +{NICE_INCREMENT}",
        "robot and grader have priority; its processor time is measured, and if it uses too much, the check fails with "
        "that figure",
    ),
    "out of memory": (f"score {OOM_SCORE}", "the kernel ends it before other processes of the machine"),
    "first process": ("hidden", "it cannot write to the memory of its sandbox's init"),
}


def promise_table() -> str:
    """Return the promises as a Markdown table."""
    rows = [f"| {what} | {value} | {meaning} |" for what, (value, meaning) in PROMISES.items()]
    return "\n".join(["| Property | Value | Meaning |", "|---|---|---|", *rows])


def posture(pid: int) -> dict[str, str]:
    """Return the security profile of a process and all its threads from /proc, in the words of the promises.

    Call it in the arena but outside the process's sandbox: it compares the namespaces of both.
    """
    threads = [_fields(f"/proc/{pid}/task/{thread}/status") for thread in os.listdir(f"/proc/{pid}/task")]
    mounts = [line.split(" - ") for line in Path(f"/proc/{pid}/mountinfo").read_text().splitlines()]
    return {
        "capabilities": _only({int(of[name], 16) for of in threads for name in _CAPABILITIES}, {0: "none"}),
        "new privileges": _only({of["NoNewPrivs"] for of in threads}, {"1": "never"}),
        "system calls": _only({of["Seccomp"] for of in threads}, {"2": "filtered"}),
        "own namespaces": ", ".join(name for name in _OWN if _namespace(pid, name) != _namespace(None, name)),
        "network": "the arena's" if _namespace(pid, "net") == _namespace(None, "net") else "another",
        "user": _only({_mapping(pid, "uid"), _mapping(pid, "gid")}, {"1000 1000 1": "1000 alone"}),
        "writable": ", ".join(sorted(filter(None, (_writable(*mount) for mount in mounts)))),
        "setuid files": "without effect" if all("nosuid" in mount[0] for mount in mounts) else "with effect",
        "descriptors": _descriptors(pid),
        "limits": _limits(pid),
        "scheduling": _scheduling(pid),
        "out of memory": f"score {Path(f'/proc/{pid}/oom_score_adj').read_text().strip()}",
        "first process": "seen" if os.listdir(f"/proc/{pid}/root/proc/1") else "hidden",
    }


def _fields(status: str) -> dict[str, str]:
    lines = Path(status).read_text().splitlines()
    return {name: value.strip() for name, _, value in (line.partition(":") for line in lines)}


def _only(seen: set, words: Mapping) -> str:
    """Return the word for the only value in `seen`; list the values if there are several or it has no word."""
    one = next(iter(seen)) if len(seen) == 1 else None
    return words.get(one, f"{sorted(map(str, seen))}")


def _namespace(pid: int | None, name: str) -> str:
    return os.readlink(f"/proc/{pid or 'self'}/ns/{name}")


def _mapping(pid: int, kind: str) -> str:
    return " ".join(Path(f"/proc/{pid}/{kind}_map").read_text().split())


def _writable(where: str, what: str) -> str:
    """Return a mount with its size if programs can write files to it: not /proc, nor single devices."""
    place, options = where.split()[4:6]
    kind, _, limits = what.split()[:3]
    if "rw" not in options.split(",") or kind in ("proc", "devpts", "devtmpfs"):
        return ""
    sizes = [option[5:] for option in limits.split(",") if option.startswith("size=")]
    return f"{place} {int(sizes[0].rstrip('k')) // 1024} MiB" if sizes else place


def _descriptors(pid: int) -> str:
    targets = [
        os.readlink(f"/proc/{pid}/fd/{number}").split(":")[0] for number in os.listdir(f"/proc/{pid}/fd")
    ]
    return f"{len(targets)} pipes" if set(targets) == {"pipe"} else ", ".join(sorted(targets))


def _limits(pid: int) -> str:
    lines = Path(f"/proc/{pid}/limits").read_text().splitlines()
    values = {}
    for line in lines:
        for name, unit in _LIMITS.items():
            if line.startswith(name):
                soft, hard = line[26:].split()[:2]
                values[name] = (
                    str(int(hard) // unit) if soft == hard and hard.isdigit() else f"{soft} to {hard}"
                )
    descriptors, size, space, core, processes = (values[name] for name in _LIMITS)
    core = "no core file" if core == "0" else f"core files of {core}"
    files = f"{descriptors} descriptors, files of {size} MiB"
    return f"{files}, {space} MiB of address space, {core}, {processes} processes"


def _scheduling(pid: int) -> str:
    names = {os.SCHED_BATCH: "batch", os.SCHED_OTHER: "other", os.SCHED_IDLE: "idle"}
    nicer = os.getpriority(os.PRIO_PROCESS, pid) - os.getpriority(os.PRIO_PROCESS, 0)
    kind = os.sched_getscheduler(pid)
    return f"{names.get(kind, str(kind))}, nice {nicer:+d}"
