"""The zip for Gradescope: what is in it, and that it is the same every time."""

from __future__ import annotations

import os
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from autograder.classroom.archives.gradescope_package import TOP
from autograder.classroom.archives.student_bundle import hidden_check_ids
from course_cli.app import app


def course(*arguments: object) -> Result:
    return CliRunner().invoke(app("package"), ["package", "gradescope", *map(str, arguments)])


@pytest.fixture(scope="module")
def package(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("package") / "autograder.zip"
    done = course("--exercise", "battery_service", "--out", path)
    assert done.exit_code == 0, done.output
    return path


def test_its_root_has_the_two_scripts_which_can_be_run(package: Path) -> None:
    with zipfile.ZipFile(package) as archive:
        top = {entry.filename: entry for entry in archive.infolist() if "/" not in entry.filename}
        course_itself = archive.getinfo(f"{TOP}/course")
    assert set(top) == {"setup.sh", "run_autograder"}
    assert {entry.external_attr >> 16 for entry in [*top.values(), course_itself]} == {0o100755}


def test_the_scripts_call_the_launcher_and_nothing_else(package: Path, tmp_path: Path) -> None:
    launcher = tmp_path / "source" / TOP / "course"
    launcher.parent.mkdir(parents=True)
    launcher.write_text('#!/bin/sh\necho "launcher: $*"\nexit 7\n')
    launcher.chmod(0o755)
    wanted = {
        "setup.sh": "--help",
        "run_autograder": f"gradescope --root {tmp_path} --exercise battery_service",
    }
    for name, arguments in wanted.items():
        with zipfile.ZipFile(package) as archive:
            script = archive.read(name)
        (tmp_path / name).write_bytes(script)
        done = subprocess.run(
            ["/bin/bash", tmp_path / name],
            capture_output=True,
            text=True,
            env={"GRADESCOPE_ROOT": str(tmp_path), "PATH": "/nowhere"},
        )
        assert (done.returncode, done.stdout, done.stderr) == (7, f"launcher: {arguments}\n", "")
        assert b"${GRADESCOPE_ROOT:-/autograder}" in script


def test_it_holds_visible_checks_and_no_more(package: Path) -> None:
    with zipfile.ZipFile(package) as archive:
        names = archive.namelist()
        content = b"\n".join(map(archive.read, names))
    assert f"{TOP}/checks/battery_service/checks.py" in names
    assert not [
        name for name in names if "hidden.py" in name or "/known/" in name or name.startswith("solutions")
    ]
    assert not [name for name in names if "checks/" in name and "battery_service" not in name]
    assert [check for check in hidden_check_ids() if check.encode() in content] == []
    assert b"### BEGIN SOLUTION" not in content


def test_its_modules_import_only_modules_that_it_contains(package: Path, tmp_path: Path) -> None:
    program = """
import importlib, pkgutil
import autograder, course_cli, robot_sim, ros_runtime
assert autograder.__file__.startswith(HERE), autograder.__file__
for package in (autograder, course_cli):
    for module in pkgutil.walk_packages(package.__path__, package.__name__ + "."):
        importlib.import_module(module.name)
from autograder.engine.exercise import exercise_names, load_exercise
print(*[check.hidden for name in exercise_names() for check in load_exercise(name, hidden=True).checks])
"""
    with zipfile.ZipFile(package) as archive:
        archive.extractall(tmp_path)
    here = tmp_path / TOP
    done = subprocess.run(
        [sys.executable, "-c", f"HERE = {str(here)!r}\n{program}"],
        cwd=here,
        env={**os.environ, "PYTHONPATH": str(here), "PYTHONDONTWRITEBYTECODE": "1"},
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    assert set(done.stdout.split()) == {"False"}


def test_the_same_clone_makes_the_same_bytes(package: Path, tmp_path: Path) -> None:
    course("--exercise", "battery_service", "--out", tmp_path / "again.zip")
    assert (tmp_path / "again.zip").read_bytes() == package.read_bytes()


@pytest.mark.parametrize(
    ("exercise", "said"), [("nothing", "there are"), ("arm_architecture", "a person marks it")]
)
def test_an_exercise_without_checks_is_refused(tmp_path: Path, exercise: str, said: str) -> None:
    done = course("--exercise", exercise, "--out", tmp_path / "a.zip")
    assert done.exit_code == 2
    assert said in done.output
    assert not (tmp_path / "a.zip").exists()
