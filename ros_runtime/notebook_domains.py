"""The ROS domains of the lab's notebooks, which the terminals beside them join.

Each notebook has a domain of its own. `course lab` creates a file and passes its path to all kernels and terminals in
an environment variable. A notebook appends its domain to the file when it joins the domain. The file is in memory and
disappears when the lab's process ends.
"""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path

from ros_runtime.ros_domain import is_reserved

VARIABLE = "COURSE_NOTEBOOK_DOMAINS"
EXPECTED = "COURSE_NOTEBOOK_NODES"  # variable in a notebook's cells: full names of the nodes that run
_FILE = "course-lab-domains"


def lab_variables() -> dict[str, str]:
    """Create the file to which a new lab's notebooks append their domains; return the variable with its path.

    The file exists as long as this process, also after an `exec`.
    """
    descriptor = os.memfd_create(_FILE, flags=0)  # without MFD_CLOEXEC
    return {VARIABLE: f"/proc/{os.getpid()}/fd/{descriptor}"}


def announce(domain_id: int) -> None:
    """Add this notebook's domain to the lab's file, if it runs in a lab."""
    if file := _file_of_the_lab():
        with file.open("a", encoding="utf-8") as domains:
            domains.write(f"{domain_id}\n")


def latest() -> int | None:
    """Return the domain that was joined last by a notebook that still runs; None if there is none."""
    file = _file_of_the_lab()
    announced = file.read_text(encoding="utf-8").split() if file else []
    return next((int(domain) for domain in reversed(announced) if is_reserved(int(domain))), None)


def _file_of_the_lab() -> Path | None:
    """Return the lab's file; None outside a lab or after its end, when another process may have the lab's id."""
    file = Path(os.environ.get(VARIABLE, ""))
    with suppress(OSError):
        if _FILE in os.readlink(file):
            return file
    return None


def expect_node(name: str) -> None:
    """Register a running node, so that ros2 commands in this notebook's cells wait until they discover it.

    A name that is registered twice stands for two nodes.
    """
    os.environ[EXPECTED] = " ".join(sorted([*expected_nodes(), name]))


def forget_node(name: str) -> None:
    """Unregister one node of this name."""
    nodes = expected_nodes()
    if name in nodes:
        nodes.remove(name)
    os.environ[EXPECTED] = " ".join(nodes)


def expected_nodes() -> list[str]:
    """Return the full names of the registered nodes of this notebook, one entry per node."""
    return os.environ.get(EXPECTED, "").split()
