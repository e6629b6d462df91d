"""Starting a robot says how many robots of other notebooks still run."""

from __future__ import annotations

import os

import psutil
import pytest

from lab.running import robot
from ros_runtime.notebook_domains import VARIABLE


class Process:
    def __init__(self, arguments: str, lab: str, parent: int = 1, *, has_ended: bool = False) -> None:
        self._command = ["python", *arguments.split()]
        self._lab, self._parent, self._has_ended = lab, parent, has_ended

    def cmdline(self) -> list[str]:
        if self._has_ended:
            raise psutil.NoSuchProcess(1)
        return self._command

    def ppid(self) -> int:
        return self._parent

    def environ(self) -> dict[str, str]:
        return {VARIABLE: self._lab}


PROCESSES = [
    Process("-m robot_sim --namespace /robot", "ours"),
    Process("-m robot_sim --namespace /robot --scene table", "ours"),
    Process("-m robot_sim --namespace /robot", "ours", os.getpid()),
    Process("-m robot_sim --namespace /robot", "another JupyterLab"),
    Process("-m robot_sim --namespace /robot", "ours", has_ended=True),
    Process("-m ipykernel_launcher", "ours"),
]


@pytest.mark.parametrize(("lab", "count"), [("ours", 2), (None, 0)])
def test_robots_of_other_notebooks_are_counted(
    lab: str | None, count: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(robot.psutil, "process_iter", lambda: PROCESSES)
    monkeypatch.delenv(VARIABLE, raising=False)
    if lab:
        monkeypatch.setenv(VARIABLE, lab)
    assert robot._robots_of_other_notebooks() == count
