"""Containers, Binder, CI and unusual machines: all call the launcher with valid arguments."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from functools import cache
from pathlib import Path
from typing import Any

import pytest
import yaml

from autograder.engine.exercise import exercise_names
from course_cli.app import COMMANDS
from ros_runtime.project import PROJECT

COURSE = Path(sys.executable).with_name("course")
TEMPLATES = PROJECT / "docs/ci"


@cache
def help_of(command: str) -> str:
    ran = subprocess.run([COURSE, command, "--help"], capture_output=True, text=True, check=True)
    return ran.stdout


def require_launcher_call(line: str) -> None:
    """A line calls ./course with a command and options that exist."""
    words = re.sub(r"\$\{\{.*?\}\}", "VALUE", line).split()
    assert words[0] == "./course", line
    if words[1:] == ["--help"]:
        return
    assert words[1] in COMMANDS, line
    for word in words[2:]:
        assert not word.startswith("--") or word in help_of(words[1]), line


def github() -> dict[str, Any]:
    return yaml.safe_load((TEMPLATES / "github_actions.yml").read_text())


def gitlab() -> dict[str, Any]:
    return yaml.safe_load((TEMPLATES / "gitlab_ci.yml").read_text())


def test_the_github_workflow_calls_the_launcher() -> None:
    (job,) = github()["jobs"].values()
    lines = [step["run"] for step in job["steps"] if "run" in step]
    assert len(lines) == 2
    for line in lines:
        require_launcher_call(line)
    assert set(job["strategy"]["matrix"]["exercise"]) <= set(exercise_names())


def test_the_gitlab_job_calls_the_launcher() -> None:
    (job,) = gitlab().values()
    for line in (*job["before_script"], *job["script"]):
        require_launcher_call(line)
    ((matrix),) = job["parallel"]["matrix"]
    assert set(matrix["EXERCISE"]) <= set(exercise_names())


def test_ci_keeps_the_files_that_it_writes() -> None:
    (job,) = github()["jobs"].values()
    kept = next(step["with"]["path"] for step in job["steps"] if "upload-artifact" in step.get("uses", ""))
    assert any(f"--json {kept}" in step.get("run", "") for step in job["steps"])
    (other,) = gitlab().values()
    assert any(f"--json {other['artifacts']['paths'][0]}" in line for line in other["script"])


def test_the_dev_container_calls_the_launcher() -> None:
    container = json.loads((PROJECT / ".devcontainer/devcontainer.json").read_text())
    require_launcher_call(container["postCreateCommand"])


def test_the_image_is_made_by_the_launcher() -> None:
    runs = re.findall(r"^RUN (.+)$", (PROJECT / ".devcontainer/Dockerfile").read_text(), re.MULTILINE)
    assert [line for line in runs if not line.startswith("useradd ")] == ["/opt/course/course --help"]


def test_binder_installs_what_the_launcher_would() -> None:
    script = '. setup/system_packages.sh; printf "%s\\n" "${system_packages[@]}"'
    wanted = subprocess.run(
        ["bash", "-c", script], cwd=PROJECT, capture_output=True, text=True, check=True
    ).stdout
    assert (PROJECT / ".binder/apt.txt").read_text() == wanted


def test_binder_starts_the_lab_with_the_options_of_its_own_command(tmp_path: Path) -> None:
    shutil.copytree(PROJECT / ".binder", tmp_path / ".binder")
    (tmp_path / "course").write_text('#!/bin/sh\nprintf "%s\\n" "$@"\n')
    (tmp_path / "course").chmod(0o755)
    told = [
        tmp_path / ".binder/start",
        "python3",
        "-c",
        "import os",
        "--port=8888",
        "--ServerApp.base_url=/user/a/",
    ]
    printed = subprocess.run(told, cwd=tmp_path, capture_output=True, text=True, check=True).stdout
    assert printed.split() == ["lab", "--port=8888", "--ServerApp.base_url=/user/a/"]


@pytest.mark.parametrize(
    ("machine", "said"),
    [
        ({"OSTYPE": "darwin23"}, "this is darwin23, and the course runs on Linux"),
        ({"HOSTTYPE": "aarch64"}, "this processor is aarch64, and rclpy on PyPI is made for x86_64 only"),
    ],
)
def test_an_unsupported_machine_is_reported_with_an_alternative(machine: dict[str, str], said: str) -> None:
    script = ". setup/machine.sh; ros=wheels; refuse_machine"
    told = subprocess.run(
        ["bash", "-c", script],
        cwd=PROJECT,
        env={**os.environ, **machine},
        capture_output=True,
        text=True,
        check=False,
    )
    assert told.returncode == 1
    assert said in told.stderr
    assert "docs/any_machine.md" in told.stderr


def test_another_processor_with_ros_from_apt_is_no_obstacle() -> None:
    script = ". setup/machine.sh; ros=apt; refuse_machine"
    environment = {**os.environ, "HOSTTYPE": "aarch64"}
    assert subprocess.run(["bash", "-c", script], cwd=PROJECT, env=environment, check=False).returncode == 0


def test_the_launcher_checks_the_machine_before_set_up(tmp_path: Path) -> None:
    for name in ("course", "setup"):
        copy = shutil.copytree if (PROJECT / name).is_dir() else shutil.copy2
        copy(PROJECT / name, tmp_path / name)
    environment = {
        name: value for name, value in os.environ.items() if not name.startswith(("ROS_", "AMENT_"))
    }
    told = subprocess.run(
        [tmp_path / "course", "lab"],
        env={**environment, "OSTYPE": "darwin23"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert told.returncode == 1
    assert "the course runs on Linux" in told.stderr
    assert not (tmp_path / ".venv").exists()
