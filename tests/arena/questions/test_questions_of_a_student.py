"""`course questions` runs a student's program and its changed copies in arenas; the keys say what a client saw."""

from __future__ import annotations

import csv

from typer.testing import CliRunner

from autograder.engine.exercise import exercises_folder
from course_cli.app import app


def test_questions_on_a_plain_service_have_keys_from_real_runs(tmp_path):
    known = exercises_folder() / "battery_service" / "known" / "correct" / "class_based.py"
    program = known.read_text(encoding="utf-8")
    (tmp_path / "submitted" / "anna").mkdir(parents=True)
    (tmp_path / "submitted" / "anna" / "battery_service.py").write_text(program, encoding="utf-8")
    words = ["battery_service", str(tmp_path / "submitted"), "--out", str(tmp_path / "out")]
    result = CliRunner().invoke(app("questions"), ["questions", *words])
    assert result.exit_code == 0, result.output

    with (tmp_path / "out" / "battery_service" / "questions.csv").open(
        encoding="utf-8-sig", newline=""
    ) as file:
        parts = list(csv.DictReader(file))
    assert {part["kind"] for part in parts} == {"moment", "executor", "change"}
    lines = program.split("\n")
    for part in parts:
        code = lines[int(part["line"]) - 1].strip().removesuffix(":")
        assert code[:100] in f"{part['key']} {part['asked']} {part['situation']}" or part["part"] != "a"
    for part in (one for one in parts if one["asked"].startswith("Suppose")):
        assert "expected" in part["key"]
        assert "observed" in part["key"]
    page = (tmp_path / "out" / "battery_service" / "students" / "anna.html").read_text(encoding="utf-8")
    assert "observed" not in page
