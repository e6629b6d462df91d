"""The console script `course`."""

from __future__ import annotations

import subprocess
import sys
from importlib.metadata import version
from pathlib import Path

import pytest
from typer.testing import CliRunner

from course_cli.app import app, load

COURSE = Path(sys.executable).with_name("course")


def course(*arguments: str, cwd: Path | None = None) -> subprocess.CompletedProcess[str]:
    return subprocess.run([COURSE, *arguments], capture_output=True, text=True, cwd=cwd)


def test_help_lists_the_commands_that_exist_without_importing_them() -> None:
    code = (
        "import sys, course_cli.app\n"
        "try: course_cli.app.main(['--help'])\n"
        "finally: print([m for m in sys.modules if '.commands.' in m or m == 'rclpy'])"
    )
    finished = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)

    assert finished.returncode == 0
    assert "test" in finished.stdout
    assert finished.stdout.splitlines()[-1] == "[]"


def test_an_unknown_command_is_an_unusable_argument() -> None:
    finished = course("dance")

    assert finished.returncode == 2
    assert "dance" in finished.stderr


@pytest.mark.parametrize("name", ["lab", "ros", "sim", "test"])
def test_a_command_is_loaded_by_its_name(name: str) -> None:
    assert callable(load(name))


@pytest.mark.parametrize(("assertion", "status"), [("True", 0), ("False", 1)])
def test_the_test_command_has_pytests_exit_status(tmp_path: Path, assertion: str, status: int) -> None:
    test_file = tmp_path / "test_sample.py"
    test_file.write_text(f"def test_sample():\n    assert {assertion}\n")

    finished = course("test", str(test_file), "-q", "-n", "0", "-p", "no:cacheprovider")

    assert finished.returncode == status
    assert ("1 passed" if status == 0 else "1 failed") in finished.stdout.splitlines()[-1]


def test_the_robot_node_gets_its_own_arguments() -> None:
    finished = course("sim", "--scene", "moon")

    assert finished.returncode == 2
    assert "moon" in finished.stderr


def test_jupyterlab_gets_its_own_arguments() -> None:
    finished = course("lab", "--version")

    assert finished.returncode == 0
    assert finished.stdout.strip() == version("jupyterlab")


def test_the_help_of_the_lab_names_what_it_opens() -> None:
    finished = course("lab", "--help")

    assert finished.returncode == 0
    assert "chapters and exercises" in finished.stdout


def test_the_help_shows_no_type_behind_a_flag() -> None:
    for name, flag in (("check", "--record"), ("replay", "--text"), ("grade", "--resume")):
        shown = CliRunner().invoke(app(name), [name, "--help"]).output
        assert flag in shown
        assert "bool" not in shown


def test_a_misspelled_exercise_gets_a_suggestion_and_any_other_name_the_list() -> None:
    assert "there is no exercise 'paterns'; did you mean patterns?" in course("check", "paterns").stdout
    assert "there are arm_architecture, " in course("check", "zzz").stdout
