"""The ROS domains of the lab's notebooks, which the terminals beside them join.

Each notebook has a domain of its own. `course lab` names a file in the environment of all its kernels and terminals;
a notebook adds its domain there when it joins one.
"""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

from ros_runtime.ros_domain import is_reserved

VARIABLE = "COURSE_NOTEBOOK_DOMAINS"
EXPECTED = "COURSE_NOTEBOOK_NODES"  # in the environment of a notebook's cells: full names of nodes that run


def lab_variables() -> dict[str, str]:
    """Create the file in which a new lab's notebooks write their domains; return the variable that names it."""
    descriptor, path = tempfile.mkstemp(prefix="course-lab-", suffix=".domains")
    os.close(descriptor)
    return {VARIABLE: path}


def announce(domain_id: int) -> None:
    """Add this notebook's domain to the lab's file, if it runs in a lab."""
    if VARIABLE in os.environ:
        with Path(os.environ[VARIABLE]).open("a", encoding="utf-8") as domains:
            domains.write(f"{domain_id}\n")


def latest() -> int | None:
    """Return the domain of the notebook that joined last, of those that still run; None if there is none."""
    try:
        announced = Path(os.environ[VARIABLE]).read_text(encoding="utf-8").split()
    except (KeyError, FileNotFoundError):
        return None
    return next((int(domain) for domain in reversed(announced) if is_reserved(int(domain))), None)


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
