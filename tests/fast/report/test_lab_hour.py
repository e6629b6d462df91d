"""`course hour`: what students share from a self-check, and what the page for the lab shows of it."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from bs4 import BeautifulSoup
from typer.testing import CliRunner

from autograder import lab_hour
from autograder.engine.verdict import CheckVerdict, Grade
from autograder.self_check import SelfCheck
from course_cli.app import app


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    shared = tmp_path / "shared"
    shared.mkdir()
    monkeypatch.setenv(lab_hour.VARIABLE, str(shared))
    return shared


def checked(*statuses: str, exercise: str = "walk_to") -> SelfCheck:
    checks = [CheckVerdict(f"c{n}", f"Check <{n}>", status, 0, 1) for n, status in enumerate(statuses)]  # type: ignore[arg-type]
    return SelfCheck(Grade(exercise, "somebody", "namespaces", checks))


def at_the_desk_of(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(lab_hour.getpass, "getuser", lambda: name)


def page_of(folder: Path, *options: str) -> str:
    out = folder.parent / "hour.html"
    ran = CliRunner().invoke(app("hour"), ["hour", str(folder), "--once", "--out", str(out), *options])
    assert ran.exit_code == 0, ran.output
    return BeautifulSoup(out.read_text(), "html.parser").get_text(" ", strip=True)


def test_the_page_shows_who_is_stuck_where_without_names(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for name in ("anna", "bert"):
        at_the_desk_of(name, monkeypatch)
        checked("passed", "failed", "not run").share("row 3")
    said = capsys.readouterr().out
    at_the_desk_of("carl", monkeypatch)
    checked("passed", "passed", exercise="patterns").share()

    assert "walk_to, 1 of 3 checks passed, first failed check: Check <1>, row 3" in said
    shown = page_of(folder)
    assert "walk_to Check <1> 2 0" in shown
    assert "patterns all visible checks pass 1" in shown
    assert "row 3, row 3" in page_of(folder, "--places")
    for secret in ("anna", "bert", "somebody", "row 3"):
        assert secret not in shown
        assert secret not in "".join(path.name for path in folder.iterdir())


def test_waiting_is_counted_from_the_first_share_of_the_same_check(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(lab_hour.time, "time", lambda: 1000.0)
    checked("failed").share()
    monkeypatch.setattr(lab_hour.time, "time", lambda: 1600.0)
    checked("failed").share()

    (group,) = lab_hour.groups(folder, 1720.0)
    assert group.minutes == [12]

    checked("passed", "failed").share()
    (group,) = lab_hour.groups(folder, 1720.0)
    assert (group.check, group.minutes) == ("Check <1>", [2])


def test_of_groups_that_wait_equally_long_the_larger_comes_first(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(lab_hour.time, "time", lambda: 1000.0)
    for name, exercise in (("anna", "battery_guard"), ("bert", "walk_to"), ("carl", "walk_to")):
        at_the_desk_of(name, monkeypatch)
        checked("failed", exercise=exercise).share()
    assert [group.exercise for group in lab_hour.groups(folder, 1720.0)] == ["walk_to", "battery_guard"]


def test_what_is_shared_goes_at_once_and_after_a_session(folder: Path) -> None:
    checked("failed").share()
    checked("failed").unshare()
    assert list(folder.iterdir()) == []

    checked("failed").share()
    (entry,) = folder.iterdir()
    os.utime(entry, (0, 0))
    assert "Nobody shares a self-check yet" in page_of(folder)
    assert list(folder.iterdir()) == []


def test_other_files_are_ignored(folder: Path) -> None:
    for name, text in (("a", "{"), ("b", '{"exercise": 1}'), ("c", "x" * 5000)):
        (folder / f"{name}.json").write_text(text)
    (folder / "d.json").symlink_to("/etc/passwd")
    assert "Nobody shares" in page_of(folder)


def test_without_a_folder_sharing_says_what_is_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv(lab_hour.VARIABLE, raising=False)
    with pytest.raises(lab_hour.CannotShare, match="COURSE_LAB_HOUR names nothing"):
        checked("failed").share()
