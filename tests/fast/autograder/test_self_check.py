"""A self-check, in the notebook and on the command line, is stored for the student's progress page."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import pytest
import typer

from autograder import self_check as module
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.engine.exercise import Exercise
from autograder.engine.grading import Watcher
from autograder.engine.submission import Submission
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
    grade: Grade, expected: list, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    kept: list[tuple] = []
    (tmp_path / "battery_service.py").write_text("print()")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(module, "check_with_progress", lambda *arguments, **options: grade)
    monkeypatch.setattr(module, "store_check", lambda *entry, **options: kept.append(entry))
    assert module.self_check("battery_service").grade is grade
    assert kept == expected


def test_the_command_keeps_it_too(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    kept: list[tuple] = []
    rows: list[bool] = []
    monkeypatch.setattr(
        module, "check_with_progress", lambda *arguments, **options: graded("passed", "failed")
    )
    monkeypatch.setattr(
        module, "store_check", lambda *entry, for_its_row: kept.append(entry) or rows.append(for_its_row)
    )
    for name in ("battery_service.py", "experiment.py"):
        program = tmp_path / name
        program.write_text("print()")
        with pytest.raises(typer.Exit) as ended:
            check("battery_service", program, json_file=None, jobs=1, course=None)
        assert ended.value.exit_code == 1
    assert kept == KEPT * 2
    assert rows == [True, False]


def test_a_notebooks_self_check_draws_what_failed_and_writes_the_page(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "battery_service.py").write_text("import rclpy\n")
    result = graded("failed")
    run = Transcript.from_events("in_order", {}, [ev.NodeReady(t=0.5, waited=0.5)])
    drawn: list[str] = []

    def grade(
        submission: Submission, exercise: Exercise, options: object, watcher: Watcher, **_: object
    ) -> Grade:
        watcher.on_evidence(result.checks[0], [run])
        return result

    table = SimpleNamespace(
        add=lambda verdict: None, draw=lambda verdict, runs: drawn.append(verdict.id), evidence={}
    )
    monkeypatch.setattr("rich.console._is_jupyter", lambda: True)
    monkeypatch.setattr(module, "save_notebook", lambda: None)
    monkeypatch.setattr(module, "_notebook_table", lambda exercise: table)
    monkeypatch.setattr(module, "grade", grade)
    monkeypatch.setattr(module, "store_check", lambda *entry, **options: None)
    monkeypatch.chdir(tmp_path)
    module.self_check("battery_service", page="shown.html")
    assert drawn == ["check_0"]
    assert "<h3>battery_service.py</h3>" in Path("shown.html").read_text()


def test_a_program_of_another_name_is_called_by_its_name(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "mine.py").write_text("import rclpy\nraise ValueError('no')\n")
    failed = replace(
        graded("failed").checks[0],
        observed="the program ended with status 1: ValueError: no",
        help="It was raised in line 2 of battery_service.py.",
        log='  File "battery_service.py", line 2, in <module>',
    )

    def grade(
        submission: Submission, exercise: Exercise, options: object, watcher: Watcher, **_: object
    ) -> Grade:
        watcher.on_verdict(failed)
        return graded("failed")

    monkeypatch.setattr(module, "grade", grade)
    monkeypatch.setattr(module, "store_check", lambda *entry, **options: None)
    module.self_check("battery_service", tmp_path / "mine.py")
    printed = capsys.readouterr().out
    assert "line 2 of mine.py (`raise ValueError('no')`)" in printed
    assert 'File "mine.py", line 2' in printed
    assert "battery_service.py" not in printed
