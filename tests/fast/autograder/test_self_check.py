"""A self-check, in the notebook and on the command line, is stored for the student's progress page."""

from __future__ import annotations

from pathlib import Path

import pytest
import typer

from autograder import self_check as module
from autograder.engine.verdict import CheckStatus, CheckVerdict, Grade
from course_cli.commands.check import check

KEPT = [("battery_service", 1, 2, "3f2a91c06b1d")]


def graded(*statuses: CheckStatus) -> Grade:
    checks = [CheckVerdict(f"check_{n}", "Title", status, 0, 1) for n, status in enumerate(statuses)]
    return Grade("battery_service", "me", "none", checks, program="3f2a91c06b1d")


@pytest.mark.parametrize(
    ("grade", "expected"),
    [(graded("passed", "failed"), KEPT), (graded("passed", "error"), []), (graded(), [])],
)
def test_it_is_kept_when_every_check_was_judged(
    grade: Grade, expected: list, monkeypatch: pytest.MonkeyPatch
) -> None:
    kept: list[tuple] = []
    monkeypatch.setattr(module, "check_with_progress", lambda *arguments, **options: grade)
    monkeypatch.setattr(module, "store_check", lambda *entry: kept.append(entry))
    assert module.self_check("battery_service").grade is grade
    assert kept == expected


def test_the_command_keeps_it_too(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    kept: list[tuple] = []
    monkeypatch.setattr(
        module, "check_with_progress", lambda *arguments, **options: graded("passed", "failed")
    )
    monkeypatch.setattr(module, "store_check", lambda *entry: kept.append(entry))
    with pytest.raises(typer.Exit) as ended:
        check("battery_service", tmp_path / "missing.py", json_file=None, jobs=1, course=None)
    assert ended.value.exit_code == 1
    assert kept == KEPT
