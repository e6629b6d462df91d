"""Grading is refused if a sandbox would contain solutions, hidden checks or other students' work."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest
from typer.testing import CliRunner

from autograder.classroom.class_grading import prepared_batch
from autograder.engine.path_exposure import require_hidden
from autograder.isolation.arena_spec import Kind
from autograder.isolation.availability import Isolation
from course_cli.app import app
from ros_runtime.course_error import CommandFailed
from ros_runtime.project import PROJECT


@pytest.mark.parametrize(
    "path",
    [
        "/usr",
        "/usr/src/course/solutions",
        "/usr/local/../src/course/solutions",
        "/bin/solutions",
        "/lib/course",
        f"{sys.prefix}/graded",
        str(PROJECT / "ros_runtime/submitted"),
    ],
)
def test_files_inside_a_visible_folder_are_refused(path: str) -> None:
    with pytest.raises(CommandFailed, match=r"nothing is graded: .* lies in .*; move it"):
        require_hidden([Path("/srv/course"), Path(path)])


def test_files_beside_or_around_it_are_allowed(tmp_path: Path) -> None:
    require_hidden([PROJECT, PROJECT / "solutions", tmp_path, Path("/usr2/src"), Path("/srv/usr/src")])


def test_a_link_is_followed_on_both_sides(tmp_path: Path) -> None:
    (tmp_path / "shown/solutions").mkdir(parents=True)
    (tmp_path / "link").symlink_to(tmp_path / "shown")
    for hidden, shown in (("link/solutions", "shown"), ("shown/solutions", "link")):
        with pytest.raises(CommandFailed):
            require_hidden([tmp_path / hidden], [tmp_path / shown])


def test_the_command_refuses_and_writes_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    work = tmp_path / "ada" / "battery_service.py"
    work.parent.mkdir()
    work.write_text("print()")
    monkeypatch.setattr(
        prepared_batch, "available_isolation", lambda: Isolation(Kind.NAMESPACES, "it is said")
    )
    out = Path(sys.prefix, "graded")
    ran = CliRunner().invoke(app("grade"), ["grade", str(tmp_path), "--out", str(out)])
    assert ran.exit_code == 1
    assert "nothing is graded" in ran.output
    assert not out.exists()
