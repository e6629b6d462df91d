"""The terminals of a lab find the domain of a notebook, and its notebooks the robot that one of them has started."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from pathlib import Path
from subprocess import PIPE, Popen

import pytest

from ros_cli.app import join_domain
from ros_runtime import notebook_domains
from ros_runtime.ros_domain import ReservedDomain


@pytest.fixture(autouse=True)
def own_machine(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    for name in ("ROS_DOMAIN_ID", notebook_domains.VARIABLE, notebook_domains.NOTEBOOK):
        monkeypatch.setenv(name, "")  # so that it is put back
        monkeypatch.delenv(name)


@pytest.fixture
def lab(monkeypatch: pytest.MonkeyPatch) -> None:
    for name, value in notebook_domains.lab_variables().items():
        monkeypatch.setenv(name, value)


@pytest.fixture
def notebooks(lab: None) -> Iterator[list[ReservedDomain]]:
    """Two notebooks that have joined their domains, one after the other."""
    domains = [ReservedDomain(), ReservedDomain()]
    for domain in domains:
        notebook_domains.announce(domain.domain_id)
    yield domains
    domains[0].release()


def test_the_latest_domain_is_that_of_the_last_notebook_that_still_runs(
    notebooks: list[ReservedDomain],
) -> None:
    earlier, later = notebooks
    assert notebook_domains.latest() == later.domain_id
    later.release()
    assert notebook_domains.latest() == earlier.domain_id


def test_a_terminal_joins_it(notebooks: list[ReservedDomain]) -> None:
    join_domain()
    assert os.environ["ROS_DOMAIN_ID"] == str(notebooks[1].domain_id)
    notebooks[1].release()


def test_a_domain_that_the_shell_has_chosen_is_kept(
    notebooks: list[ReservedDomain], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ROS_DOMAIN_ID", "5")
    join_domain()
    assert os.environ["ROS_DOMAIN_ID"] == "5"
    notebooks[1].release()


def test_a_notebook_finds_the_robot_that_another_one_has_started_last(
    lab: None, monkeypatch: pytest.MonkeyPatch
) -> None:
    def becomes(notebook: str, domain_id: int) -> None:
        monkeypatch.setenv(notebook_domains.NOTEBOOK, notebook)
        monkeypatch.setenv("ROS_DOMAIN_ID", str(domain_id))

    becomes("/home/me/chapters/01 robot.ipynb", 4)
    assert notebook_domains.robot_of_another_notebook() is None
    notebook_domains.announce_robot(4, 1000)
    assert notebook_domains.robot_of_another_notebook() is None
    becomes("/home/me/chapters/02_services.ipynb", 5)
    notebook_domains.announce(5)
    assert notebook_domains.robot_of_another_notebook() == (4, 1000, "01 robot.ipynb")
    notebook_domains.announce_robot(5, 1001)
    assert notebook_domains.robot_of_another_notebook() is None
    becomes("/home/me/chapters/01 robot.ipynb", 4)
    assert notebook_domains.robot_of_another_notebook() == (5, 1001, "02_services.ipynb")


def test_a_kernel_that_no_notebook_of_the_lab_has_takes_no_robot(
    lab: None, monkeypatch: pytest.MonkeyPatch
) -> None:
    notebook_domains.announce_robot(4, 1000)  # from a terminal of the lab
    monkeypatch.setenv(notebook_domains.NOTEBOOK, "/home/me/chapters/01 robot.ipynb")
    assert notebook_domains.robot_of_another_notebook() is None
    notebook_domains.announce_robot(4, 1000)
    monkeypatch.delenv(notebook_domains.NOTEBOOK)
    assert notebook_domains.robot_of_another_notebook() is None


def test_the_lab_leaves_no_file_behind(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    program = (
        "import os; from ros_runtime.notebook_domains import VARIABLE, lab_variables\n"
        "print(lab_variables()[VARIABLE], flush=True); os.execvp('cat', ['cat'])"
    )
    command = [sys.executable, "-c", program]
    with Popen(
        command, env=os.environ | {"TMPDIR": str(tmp_path)}, stdin=PIPE, stdout=PIPE, text=True
    ) as lab:
        assert lab.stdout
        monkeypatch.setenv(notebook_domains.VARIABLE, lab.stdout.readline().strip())
        with ReservedDomain() as domain_id:
            notebook_domains.announce(domain_id)
            assert notebook_domains.latest() == domain_id
    assert notebook_domains.latest() is None
    assert [path.name for path in tmp_path.iterdir()] == ["ros-domain-locks"]


def test_a_lab_without_a_running_notebook_has_none(lab: None) -> None:
    assert notebook_domains.latest() is None


def test_outside_the_lab_the_domain_is_not_changed() -> None:
    notebook_domains.announce(7)
    join_domain()
    assert "ROS_DOMAIN_ID" not in os.environ


def test_a_notebook_registers_the_nodes_that_its_commands_must_discover(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv(notebook_domains.EXPECTED, "")
    notebook_domains.expect_node("/robot/notebook")
    notebook_domains.expect_node("/robot/humanoid")
    assert notebook_domains.expected_nodes() == ["/robot/humanoid", "/robot/notebook"]
    notebook_domains.forget_node("/robot/humanoid")
    assert notebook_domains.expected_nodes() == ["/robot/notebook"]


def test_a_terminal_expects_the_nodes_of_the_notebook_that_it_joins(
    notebooks: list[ReservedDomain], monkeypatch: pytest.MonkeyPatch
) -> None:
    for domain, node in zip(notebooks, ("/robot/of_the_first", "/robot/of_the_second"), strict=True):
        monkeypatch.setenv(notebook_domains.EXPECTED, "")
        monkeypatch.setenv("ROS_DOMAIN_ID", str(domain.domain_id))
        notebook_domains.expect_node("/robot/notebook")
        notebook_domains.expect_node(node)
    for name in (notebook_domains.EXPECTED, "ROS_DOMAIN_ID"):
        monkeypatch.delenv(name)
    join_domain()
    assert notebook_domains.expected_nodes() == ["/robot/notebook", "/robot/of_the_second"]
    monkeypatch.setenv("ROS_DOMAIN_ID", str(notebooks[0].domain_id))
    assert notebook_domains.expected_nodes() == ["/robot/notebook", "/robot/of_the_first"]
    notebooks[1].release()


def test_two_nodes_of_one_name_are_both_expected(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(notebook_domains.EXPECTED, "")
    notebook_domains.expect_node("/robot/where_am_i")
    notebook_domains.expect_node("/robot/where_am_i")
    notebook_domains.forget_node("/robot/where_am_i")
    assert notebook_domains.expected_nodes() == ["/robot/where_am_i"]
    notebook_domains.forget_node("/robot/where_am_i")
    notebook_domains.forget_node("/robot/where_am_i")
    assert notebook_domains.expected_nodes() == []
