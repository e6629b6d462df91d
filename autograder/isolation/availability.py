"""Tests whether this machine can isolate an arena, by starting one."""

from __future__ import annotations

import os
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from autograder.isolation.arena_process import ArenaProcess, Ended
from autograder.isolation.arena_spec import ISOLATION_VARIABLE, ArenaSpec, Kind
from autograder.isolation.bubblewrap import STUDENT_FILTER, SandboxError, bwrap_path
from autograder.isolation.limits import ArenaLimits
from autograder.isolation.python_paths import python_read_only_paths
from autograder.isolation.seccomp_filter import student_filter

_PROBE_DEADLINE = 20.0  # s
_APPARMOR_SWITCH = Path("/proc/sys/kernel/apparmor_restrict_unprivileged_userns")
_NAMESPACE_SWITCH = Path("/proc/sys/kernel/unprivileged_userns_clone")


@dataclass(frozen=True)
class Isolation:
    """How arenas on this machine are isolated, and why."""

    kind: Kind
    reason: str

    @property
    def trusted(self) -> bool:
        """Whether a grade holds against hostile code, so that hidden checks can be used."""
        return self.kind is Kind.NAMESPACES

    @property
    def label(self) -> str:
        """Return the word for reports: 'namespaces', 'another-user' or 'untrusted'."""
        return "untrusted" if self.kind is Kind.NONE else self.kind.value


def available_isolation() -> Isolation:
    """Return namespaces if they work on this machine, else no isolation; the test runs once in a process.

    COURSE_ISOLATION=none switches isolation off. COURSE_ISOLATION=another-user selects what root of a container can do
    without namespaces, which is not enough for hidden checks. Raises ValueError for any other value of that variable.
    """
    wish = os.environ.get(ISOLATION_VARIABLE, "")
    if wish == Kind.NONE:
        return _without(f"{ISOLATION_VARIABLE}=none asks for no isolation")
    if wish == Kind.ANOTHER_USER:
        return with_another_user()
    if wish not in ("", Kind.NAMESPACES):
        kinds = ", ".join(repr(kind.value) for kind in Kind)
        raise ValueError(f"{ISOLATION_VARIABLE} is {wish!r}; it can be {kinds} or unset")
    return try_namespaces()


def with_another_user() -> Isolation:
    """Return the isolation that root has without namespaces: students' programs run as users who own nothing."""
    if os.geteuid() != 0:
        return _without("only root can run a student's program as another user")
    try:
        student_filter()
    except SandboxError as error:
        return _without(str(error))
    return Isolation(Kind.ANOTHER_USER, "students' programs run as users of their own, without namespaces")


@lru_cache(maxsize=1)
def try_namespaces() -> Isolation:
    """Test a sandbox inside a sandbox, in which every student's program runs."""
    try:
        nested = (
            f"exec {bwrap_path()} --unshare-user --unshare-pid --unshare-ipc --unshare-uts --cap-drop ALL"
            " --disable-userns --ro-bind / / --proc /proc --dev /dev --size 65536 --tmpfs /tmp"
            " --dev-bind /dev/full /dev/zero --tmpfs /proc/1"
        )
        script = f"{nested} --seccomp 3 -- /bin/true 3<{STUDENT_FILTER}"
        limits = ArenaLimits(deadline_s=_PROBE_DEADLINE)
        spec = ArenaSpec(["/bin/sh", "-c", script], python_read_only_paths(), limits=limits)
        report = ArenaProcess(spec, Kind.NAMESPACES).wait()
    except SandboxError as error:
        return _without(f"{error}{_advice()}")
    if report.ended is Ended.EXIT and report.exit_code == 0:
        return Isolation(Kind.NAMESPACES, "a nested bubblewrap sandbox was tried and works")
    said = report.stderr.text.strip() or report.explain(limits)
    return _without(f"a nested bubblewrap sandbox does not work here: {said}{_advice()}")


def _without(reason: str) -> Isolation:
    warning = (
        ". Students' programs run as root: grade as an ordinary user instead" if os.geteuid() == 0 else ""
    )
    return Isolation(Kind.NONE, reason + warning)


def _advice() -> str:
    """Return what an administrator can do, if a setting of the system shows the cause."""
    if _says(_APPARMOR_SWITCH, "1"):
        return ". AppArmor forbids it: sudo sysctl kernel.apparmor_restrict_unprivileged_userns=0 allows it"
    if _says(_NAMESPACE_SWITCH, "0"):
        return ". The kernel forbids it: sudo sysctl kernel.unprivileged_userns_clone=1 allows it"
    if Path("/.dockerenv").exists():
        options = [f"--security-opt {name}=unconfined" for name in ("seccomp", "apparmor", "systempaths")]
        return f". Docker needs {' '.join(options)}"
    return ""


def _says(switch: Path, value: str) -> bool:
    try:
        return switch.read_text().strip() == value
    except OSError:
        return False
