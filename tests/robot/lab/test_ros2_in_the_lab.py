"""`ros2` in the cells and the terminals of a lab: both see the notebook's own ROS domain."""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest
from kernels import Kernel

from course_cli.commands.lab import lab_environment


@pytest.fixture(scope="module")
def lab() -> Iterator[dict[str, str]]:
    """The environment of all processes that `course lab` starts; this process has it, too."""
    environment = lab_environment()
    with pytest.MonkeyPatch.context() as patch:
        patch.delenv("ROS_DOMAIN_ID", raising=False)
        for name, value in environment.items():
            patch.setenv(name, value)
        yield dict(os.environ)


@pytest.fixture(scope="module")
def notebook(lab: dict[str, str], tmp_path_factory: pytest.TempPathFactory) -> Iterator[Kernel]:
    """A notebook that has started a node."""
    folder = tmp_path_factory.mktemp("notebook")
    shutil.copy(Path(__file__).with_name("nodes") / "adder.py", folder)
    running = Kernel(folder)
    running.run("node = lab.run_node('adder.py')")
    yield running
    running.shut_down()


def in_terminal(lab: dict[str, str], line: str) -> str:
    """The output of a command line in a terminal."""
    return subprocess.run(
        ["bash", "-c", line], env=lab, capture_output=True, text=True, check=True, timeout=60
    ).stdout


def nodes_seen(lab: dict[str, str], number: int, prefix: str = "") -> list[str]:
    """List the nodes in a terminal until all are there: discovery may take longer than one command."""
    for _ in range(10):
        nodes = in_terminal(lab, f"{prefix}ros2 node list --spin-time 2").split()
        if len(nodes) >= number:
            break
    return nodes


def test_a_cell_and_a_terminal_see_the_notebooks_nodes(lab: dict[str, str], notebook: Kernel) -> None:
    from_terminal = nodes_seen(lab, 2)
    from_cell = notebook.run("!ros2 node list --spin-time 2").split()
    assert "/robot/notebook" in from_terminal
    assert len(from_terminal) == 2
    assert from_cell == from_terminal


def test_a_terminal_joins_the_notebook_that_began_last(
    lab: dict[str, str], notebook: Kernel, tmp_path: Path
) -> None:
    earlier = notebook.run("print(lab.client.connection.connection().domain_id)").strip()
    later = Kernel(tmp_path)
    try:
        later.run("lab.node()")
        assert nodes_seen(lab, 1) == ["/robot/notebook"]
        assert len(nodes_seen(lab, 2, f"ROS_DOMAIN_ID={earlier} ")) == 2
    finally:
        later.shut_down()
    assert len(nodes_seen(lab, 2)) == 2
