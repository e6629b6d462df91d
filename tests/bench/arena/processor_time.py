"""Counts the processor time of a process and of everything it starts, by a control group of the kernel.

Only root can make one. Nothing else is exact, because processes that end with a sandbox are counted nowhere else.
"""

from __future__ import annotations

import os
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from autograder.isolation.memory_group import remove_group
from ros_runtime.course_error import COMMAND_FAILED, CourseError

_PLACES = (  # with the file that says how much was used: cgroup v2, v1 and both at once
    (Path("/sys/fs/cgroup/cpuacct"), "cpuacct.usage"),
    (Path("/sys/fs/cgroup/cpu,cpuacct"), "cpuacct.usage"),
    (Path("/sys/fs/cgroup"), "cpu.stat"),
    (Path("/sys/fs/cgroup/unified"), "cpu.stat"),
)


class CannotBeMeasured(CourseError):
    """This machine or this user cannot count the processor time of a tree of processes."""

    exit_status = COMMAND_FAILED


@contextmanager
def metered_group() -> Iterator[tuple[Path, str]]:
    """Yield a new control group: the file that takes process ids and the file with their processor time.

    Raises:
        CannotBeMeasured: this machine or user cannot make one.
    """
    for place, meter in _PLACES:
        group = place / f"course-bench-{os.getpid()}-{time.monotonic_ns()}"
        try:
            group.mkdir()
        except OSError:
            continue
        try:
            if (group / meter).exists():
                yield group / "cgroup.procs", str(group / meter)
                return
        finally:
            remove_group(group)
    raise CannotBeMeasured(
        "processor time is counted by control groups (cgroups), which only root can make, where the kernel has them"
    )
