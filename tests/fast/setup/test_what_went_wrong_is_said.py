"""A failed command prints the reason in a sentence."""

from __future__ import annotations

import errno
import sqlite3

import pytest

from autograder.classroom.commands.demo import DemoFailed, _require_expected
from autograder.engine.verdict import CheckVerdict, Grade
from autograder.report.table import summary
from course_cli import app

NOT_JUDGED = CheckVerdict(
    "walks", "It walks", "error", 0, 1, help="Not graded: the machine was too busy.\nMore."
)


@pytest.mark.parametrize(
    "error",
    [
        OSError(errno.ENOSPC, "No space left on device"),
        OSError(errno.EDQUOT, "Disk quota exceeded"),
        sqlite3.OperationalError("database or disk is full"),
    ],
)
def test_a_full_disk(monkeypatch: pytest.MonkeyPatch, error: Exception) -> None:
    end_with(monkeypatch, error, r"^course: the disk is full\.(.|\n)*Next: make room")


def test_a_folder_of_somebody_else(monkeypatch: pytest.MonkeyPatch) -> None:
    error = PermissionError(errno.EACCES, "Permission denied", "/opt/course/graded")
    end_with(monkeypatch, error, r"^course: no permission for /opt/course/graded\.\nNext: give a folder")


def end_with(monkeypatch: pytest.MonkeyPatch, error: Exception, sentence: str) -> None:
    def fail() -> None:
        try:
            raise error
        except Exception as cause:
            raise RuntimeError("the gradebook could not be written") from cause

    monkeypatch.setattr(app, "load", lambda name: fail)
    with pytest.raises(SystemExit, match=sentence):
        app.main(["bench"])


def test_a_submission_that_was_not_graded() -> None:
    grade = Grade("walk_to", "right", "namespaces", [NOT_JUDGED])
    assert summary(grade) == "NOT GRADED, no score: the machine was too busy."
    with pytest.raises(DemoFailed, match=r"“right” could not be graded: .* too busy\.\nNext: .*--jobs 1"):
        _require_expected([grade])
