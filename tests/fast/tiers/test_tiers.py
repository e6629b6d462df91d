"""`course test` runs the requested tiers, which are folders."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from developer.test import TIERS, pytest_arguments

ROOT = Path(__file__).resolve().parents[3]
TEST_FILE = "def test_sample():\n    pass\n"


@pytest.fixture
def project(tmp_path: Path) -> Path:
    """A project with a test in each tier, and with the conftest and settings of this project."""
    for name in ("pyproject.toml", "tests/conftest.py"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text((ROOT / name).read_text())
    for tier in TIERS:
        write_test(tmp_path / f"tests/{tier}/topic/test_{tier}_sample.py")
    return tmp_path


def write_test(file: Path) -> None:
    file.parent.mkdir(parents=True)
    file.write_text(TEST_FILE)


def run_pytest(project: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "-q", *arguments]
    without_plugins = {**os.environ, "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"}
    return subprocess.run(command, cwd=project, env=without_plugins, capture_output=True, text=True)


def collected(project: Path, *arguments: str) -> set[str]:
    """The tiers of the tests that pytest would run."""
    lines = run_pytest(project, "--collect-only", *arguments).stdout.splitlines()
    return {line.split("/")[1] for line in lines if "::" in line}


def test_markers_and_flags_of_the_command_choose_the_same_tests(project: Path) -> None:
    assert collected(project) == set(TIERS)
    assert collected(project, "-m", "arena or robot") == {"arena", "robot"}
    assert collected(project, *pytest_arguments({"arena", "robot"}, [])) == {"arena", "robot"}
    assert collected(project, *pytest_arguments({"fast"}, ["tests/robot"])) == set()


def test_without_a_flag_every_tier_is_run_and_arguments_reach_pytest() -> None:
    assert pytest_arguments(set(), ["-k", "name"]) == ["-k", "name"]
    assert pytest_arguments(set(TIERS), ["-x"]) == ["-x"]
