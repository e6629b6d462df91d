"""Notebooks of a shared installation: each student has own copies, which updates do not change."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from course_cli.commands import lab as module
from course_cli.commands.lab import work_folder
from ros_runtime.project import PROJECT, WORK_VARIABLE


@pytest.fixture
def shared(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A read-only installation, and a home folder."""
    root = tmp_path / "shared"
    for name in ("start_here.ipynb", "chapters/01.ipynb", "exercises/patterns/patterns.ipynb", "docs/a.md"):
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text("theirs")
        (root / name).chmod(0o444)
    (root / "exercises/patterns/patterns.py").write_text("somebody's solution")
    monkeypatch.setattr(module, "COURSE", root)
    monkeypatch.setattr(os, "access", lambda path, mode: not Path(path).is_relative_to(root))
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    monkeypatch.delenv(WORK_VARIABLE, raising=False)
    return root


def test_a_student_gets_copies_that_can_be_written(shared: Path, tmp_path: Path) -> None:
    folder = work_folder()

    assert folder == tmp_path / "home/humanoid_course"
    copies = {path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()}
    assert copies == {
        "start_here.ipynb",
        "chapters/01.ipynb",
        "exercises/patterns/patterns.ipynb",
        "docs/a.md",
    }
    assert (folder / "chapters/01.ipynb").stat().st_mode & 0o200


def test_existing_work_is_not_changed_and_new_files_are_added(shared: Path, tmp_path: Path) -> None:
    mine = work_folder() / "chapters/01.ipynb"
    mine.write_text("mine")
    (shared / "chapters/02.ipynb").write_text("theirs")

    assert work_folder() == tmp_path / "home/humanoid_course"
    assert mine.read_text() == "mine"
    assert mine.with_name("02.ipynb").read_text() == "theirs"


def test_another_folder_can_be_named(shared: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(WORK_VARIABLE, str(tmp_path / "elsewhere"))
    assert work_folder() == tmp_path / "elsewhere"
    assert (tmp_path / "elsewhere/start_here.ipynb").exists()


def test_in_a_clone_of_ones_own_notebooks_stay_where_they_are(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv(WORK_VARIABLE, raising=False)
    assert work_folder() == PROJECT


def test_progress_is_kept_and_read_in_the_work_folder(tmp_path: Path) -> None:
    (tmp_path / "exercises/patterns").mkdir(parents=True)
    code = (
        "from ros_runtime.self_checks import store_check; store_check('patterns', 3, 4)\n"
        "from lab.learning.contents import CHAPTERS; print(CHAPTERS)"
    )
    printed = subprocess.run(
        [sys.executable, "-c", code],
        env={**os.environ, WORK_VARIABLE: str(tmp_path)},
        capture_output=True,
        text=True,
        check=True,
    ).stdout
    assert printed.strip() == str(tmp_path / "chapters")
    kept = json.loads((tmp_path / "exercises/.progress.json").read_text())
    assert kept["checks"]["patterns"]["passed"] == 3


def test_a_server_of_jupyterhub_needs_jupyterhub(tmp_path: Path) -> None:
    course = Path(sys.executable).with_name("course")
    environment = {**os.environ, "JUPYTERHUB_API_TOKEN": "secret", WORK_VARIABLE: str(tmp_path)}
    said = subprocess.run([course, "lab"], env=environment, capture_output=True, text=True, check=False)
    assert said.returncode == 1
    assert "uv pip install" in said.stdout
    assert "secret" not in said.stdout + said.stderr
