"""The ROS domains of the lab's notebooks, which the terminals beside them join, and the robots and nodes in them.

Each notebook has a domain of its own. `course lab` creates a file and passes its path to all kernels and terminals in
an environment variable. A notebook appends a line to the file when it joins its domain, starts a robot, or starts or
stops a node. The file is in memory and disappears when the lab's process ends.
"""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

from ros_runtime.ros_domain import is_reserved

VARIABLE = "COURSE_NOTEBOOK_DOMAINS"
EXPECTED = "COURSE_NOTEBOOK_NODES"  # variable in a notebook's cells: full names of the nodes that run
NOTEBOOK = (
    "JPY_SESSION_NAME"  # Jupyter's variable with the path of a kernel's notebook; terminals do not have it
)
_FILE = "course-lab-domains"


class LabRobot(NamedTuple):
    """A robot that a notebook of the lab has started, and the process id of its simulator."""

    domain_id: int
    pid: int
    notebook: str


def lab_variables() -> dict[str, str]:
    """Create the file to which a new lab's notebooks append their domains; return the variable with its path.

    The file exists as long as this process, also after an `exec`.
    """
    descriptor = os.memfd_create(_FILE, flags=0)  # without MFD_CLOEXEC
    return {VARIABLE: f"/proc/{os.getpid()}/fd/{descriptor}"}


def announce(domain_id: int) -> None:
    """Add this notebook's domain to the lab's file, if it runs in a lab."""
    _append(domain_id, "joined")


def announce_robot(domain_id: int, pid: int) -> None:
    """Add the robot that this notebook has started to the lab's file, if it runs in a lab."""
    if is_notebook_of_a_lab():
        _append(domain_id, f"robot {pid} {Path(os.environ[NOTEBOOK]).name}")


def robot_of_another_notebook() -> LabRobot | None:
    """Return the lab's last robot, if another notebook than this one has started it; it may have ended since."""
    robots = [
        LabRobot(domain, int(pid), notebook)
        for domain, line in _lines("robot")
        for pid, notebook in [line.split(maxsplit=1)]
    ]
    if (
        not robots
        or not is_notebook_of_a_lab()
        or str(robots[-1].domain_id) == os.environ.get("ROS_DOMAIN_ID")
    ):
        return None
    return robots[-1]


def is_notebook_of_a_lab() -> bool:
    """Whether this process is the kernel of a notebook that `course lab` serves, so JupyterLab shows it."""
    return NOTEBOOK in os.environ and is_in_a_lab()


def latest() -> int | None:
    """Return the domain of the notebook that wrote the last line and still runs; None if there is none."""
    return next((domain for domain, _ in reversed(_lines("")) if is_reserved(domain)), None)


def is_in_a_lab() -> bool:
    """Whether this process is a kernel or a terminal of `course lab`, or was started by one."""
    return _file_of_the_lab() is not None


def _append(domain_id: int | str, line: str) -> None:
    if file := _file_of_the_lab():
        with file.open("a", encoding="utf-8") as announced:
            announced.write(f"{domain_id} {line}\n")


def _lines(kind: str) -> list[tuple[int, str]]:
    """Return the domain and the rest of each line of a kind in the lab's file: joined, robot, nodes, or "" for all."""
    file = _file_of_the_lab()
    announced = file.read_text(encoding="utf-8").splitlines() if file else []
    lines = [line.partition(" ") for line in announced]
    return [(int(domain), line.removeprefix(kind)) for domain, _, line in lines if line.startswith(kind)]


def _file_of_the_lab() -> Path | None:
    """Return the lab's file; None outside a lab or after its end, when another process may have the lab's id."""
    file = Path(os.environ.get(VARIABLE, ""))
    with suppress(OSError):
        if _FILE in os.readlink(file):
            return file
    return None


def expect_node(name: str) -> None:
    """Register a running node, so that ros2 commands in this notebook's domain wait until they discover it.

    A name that is registered twice stands for two nodes.
    """
    _expect(sorted([*expected_nodes(), name]))


def forget_node(name: str) -> None:
    """Unregister one node of this name."""
    nodes = expected_nodes()
    if name in nodes:
        nodes.remove(name)
        _expect(nodes)


def expected_nodes() -> list[str]:
    """Return the full names of the registered nodes in this process's domain, one entry per node."""
    domain_id = os.environ.get("ROS_DOMAIN_ID")
    announced = [line for domain, line in _lines("nodes") if str(domain) == domain_id]
    return os.environ.get(EXPECTED, announced[-1] if announced else "").split()


def _expect(nodes: list[str]) -> None:
    os.environ[EXPECTED] = " ".join(nodes)
    if domain_id := os.environ.get("ROS_DOMAIN_ID"):
        _append(domain_id, f"nodes {os.environ[EXPECTED]}")
