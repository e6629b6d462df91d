"""System packages: for root they are installed, for other users the command is printed."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]


class Machine:
    """A machine with only the programs in its `bin`, which does not have bubblewrap."""

    def __init__(self, folder: Path) -> None:
        self.bin = folder / "bin"
        self.calls = folder / "calls"
        self.bin.mkdir()
        (folder / "build").mkdir()
        for program in ("cat", "mkdir", "rm", "touch", "chmod"):
            (self.bin / program).symlink_to(f"/bin/{program}")

    def program(self, name: str, script: str) -> None:
        path = self.bin / name
        path.write_text(f"#!/bin/sh\n{script}\n")
        path.chmod(0o755)

    def ensure(self, *packages: str) -> str:
        """The output of the launcher when it needs `packages`."""
        script = '. "$SETUP/system_packages.sh"; ensure_system_packages "$@"'
        environment = {"PATH": str(self.bin), "SETUP": str(ROOT / "setup"), "root": str(self.bin.parent)}
        command = ["/bin/bash", "-u", "-c", script, "ensure", *packages]
        return subprocess.run(command, env=environment, capture_output=True, text=True, check=True).stderr


@pytest.fixture
def machine(tmp_path: Path) -> Machine:
    return Machine(tmp_path)


def test_a_user_gets_the_command_to_type_and_the_missing_features(machine: Machine) -> None:
    machine.program("id", "echo 1000")
    machine.program("apt-get", f'echo "$@" >>{machine.calls}')

    said = machine.ensure("bubblewrap", "g++")

    assert "sudo apt-get install -y bubblewrap g++" in said
    assert "without bubblewrap: submissions cannot be isolated" in said
    assert "without g++: the ROS interfaces cannot be built" in said
    assert not machine.calls.exists()


def test_nothing_is_printed_if_no_package_is_missing(machine: Machine) -> None:
    machine.program("bwrap", "")

    assert machine.ensure("bubblewrap") == ""


def test_root_gets_them_from_apt(machine: Machine) -> None:
    machine.program("id", "echo 0")
    machine.program(
        "apt-get",
        f'echo "$DEBIAN_FRONTEND $@" >>{machine.calls}\n'
        f'case "$*" in *install*) touch {machine.bin}/bwrap; chmod +x {machine.bin}/bwrap;; esac',
    )

    said = machine.ensure("bubblewrap")

    update, install = machine.calls.read_text().splitlines()
    assert update.startswith("noninteractive")
    assert update.endswith("update")
    assert install.endswith("install -y --no-install-recommends bubblewrap")
    assert "missing" not in said


def test_a_failing_apt_is_tried_once_and_then_reported(machine: Machine) -> None:
    machine.program("id", "echo 0")
    machine.program("apt-get", f'echo "$@" >>{machine.calls}; exit 100')

    first = machine.ensure("bubblewrap")
    asked = machine.calls.read_text()
    second = machine.ensure("bubblewrap")

    assert "sudo apt-get install -y bubblewrap" in first
    assert "sudo apt-get install -y bubblewrap" in second
    assert machine.calls.read_text() == asked != ""


def test_one_package_that_apt_lacks_does_not_prevent_others(machine: Machine) -> None:
    machine.program("id", "echo 0")
    machine.program(
        "apt-get",
        'case "$*" in *g++*) exit 100;; '
        f"*bubblewrap*) touch {machine.bin}/bwrap; chmod +x {machine.bin}/bwrap;; esac",
    )

    said = machine.ensure("g++", "bubblewrap")

    assert os.access(machine.bin / "bwrap", os.X_OK)
    assert "sudo apt-get install -y g++\n" in said
