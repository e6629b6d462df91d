"""`course export` as an instructor types it."""

from __future__ import annotations

import csv
import io
import json
import re
import zipfile
from dataclasses import replace
from pathlib import Path

import pytest
from graded_class import ANNA, BERT, CLEO, DORA, SAME, SECRETS, WORKSHEET, grade, graded_folder, visible
from typer.testing import CliRunner, Result

from autograder.classroom.export.formats import FORMATS
from autograder.classroom.pages.history import with_day, write_history
from autograder.classroom.pages.pages import write_submission_pages
from course_cli.app import app


def course(*arguments: object) -> Result:
    return CliRunner().invoke(app("export"), ["export", *map(str, arguments)])


def files(folder: Path) -> list[str]:
    return sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file())


@pytest.mark.parametrize("name", FORMATS)
def test_every_format_is_written(tmp_path: Path, name: str) -> None:
    graded = graded_folder(tmp_path / "graded", ANNA, BERT)
    more = ["--classroom", "robotics", "--assignment", "battery_service=4711"]
    (tmp_path / "roster.csv").write_text("Student,ID,SIS Login ID,Section\nAnna,1,anna,A\nBert,2,bert,A\n")
    if name == "canvas":
        more += ["--roster", str(tmp_path / "roster.csv")]
    done = course("--format", name, "--from", graded, "--out", tmp_path / "out", *more)
    assert done.exit_code == 0, done.output
    assert len(files(tmp_path / "out")) == (1 if name in ("canvas", "moodle") else 2)


def test_it_writes_beside_the_grades_and_names_what_has_no_score(tmp_path: Path) -> None:
    graded = graded_folder(tmp_path / "graded")
    done = course("--format", "csv", "--from", graded)
    assert done.exit_code == 0
    assert files(graded / "exports") == ["csv/class_history.csv", "csv/grades.csv"]
    assert "cleo's battery_service: not graded" in done.output
    assert "emil's arm_architecture: not marked yet" in done.output


def test_what_the_class_failed_at_is_exported_with_clause_and_lesson_and_without_students(
    tmp_path: Path,
) -> None:
    failed = visible(
        "failed", promise="clause 4, “Every request …”", help="Spin.", lesson="02_services#m9-why"
    )
    batch = [grade("anna", visible(), ANNA.checks[1]), grade("bert", failed, *BERT.checks[1:])]
    graded = graded_folder(tmp_path / "graded", *batch)
    earlier = [grade("anna", failed), grade("bert", failed)]
    write_history(graded, with_day((), "2026-02-20", earlier))
    done = course("--format", "csv", "--from", graded)
    assert done.exit_code == 0
    text = (graded / "exports" / "csv" / "class_history.csv").read_text()
    before, now = csv.DictReader(io.StringIO(text))
    assert (before["day"], before["failed"], before["judged"]) == ("2026-02-20", "2", "2")
    assert (now["failed"], now["judged"]) == ("1", "2")
    assert now["clause"] == "clause 4, “Every request …”"
    assert now["lesson"] == "chapters/02_services.ipynb, “Break it: ask before there is an answer”"
    assert not [word for word in ("anna", "bert", *SECRETS) if word in text]
    course("--format", "csv", "--from", graded, "--hidden", "show")
    assert "a secret title" in (graded / "exports" / "csv" / "class_history.csv").read_text()


def test_the_score_of_a_removed_grade_is_removed(tmp_path: Path) -> None:
    graded = graded_folder(tmp_path / "graded", ANNA)
    course("--format", "classroom50", "--classroom", "c", "--from", graded)
    assert files(graded / "exports") == ["classroom50/anna/battery_service/result.json"]
    graded_folder(graded, type(ANNA)("battery_service", "anna", "namespaces", reason="broken"))
    done = course("--format", "classroom50", "--classroom", "c", "--from", graded)
    assert done.exit_code == 1
    assert files(graded / "exports") == []


def test_grades_that_a_platform_cannot_represent_end_with_status_1(tmp_path: Path) -> None:
    done = course("--format", "classroom50", "--classroom", "c", "--from", graded_folder(tmp_path, DORA))
    assert done.exit_code == 1
    assert "dora's arm_architecture: 2.5 points" in done.output


def test_the_file_of_a_self_check_is_exported_too(tmp_path: Path) -> None:
    path = tmp_path / "verdicts.json"
    path.write_text(json.dumps(CLEO.to_json()))
    done = course("--format", "gradescope", "--from", path, "--out", tmp_path / "out")
    assert done.exit_code == 0
    assert "score" not in json.loads((tmp_path / "out/cleo/battery_service/results.json").read_text())


def test_only_the_named_exercise_is_exported_and_the_files_of_others_stay(tmp_path: Path) -> None:
    graded = graded_folder(tmp_path / "graded", ANNA, DORA)
    assert course("--format", "moodle", "--from", graded).exit_code == 0
    (graded / "exports/moodle/arm_architecture.csv").write_text("as it was")
    done = course("--format", "moodle", "--from", graded, "--exercise", "battery_service")
    assert done.exit_code == 0
    assert (graded / "exports/moodle/arm_architecture.csv").read_text() == "as it was"
    assert "1 file in" in done.output
    course("--format", "csv", "--from", graded, "--exercise", "battery_service")
    assert "arm_architecture" not in (graded / "exports/csv/grades.csv").read_text()
    unknown = course("--format", "csv", "--from", graded, "--exercise", "walk_to")
    assert unknown.exit_code == 2
    assert "arm_architecture, battery_service" in unknown.output


def test_moodles_worksheet_goes_back_with_the_students_pages(tmp_path: Path) -> None:
    """Moodle finds a feedback file's student by the number between the first two underscores of its name."""
    students = ["Anna_Lee-9001", "bert@x.org"]
    grades = [replace(one, student=name) for one, name in zip((ANNA, SAME), students, strict=True)]
    graded = graded_folder(tmp_path / "graded", *grades, replace(DORA, student=students[0]))
    for one in grades:
        write_submission_pages(graded, one, {})
    (tmp_path / "worksheet.csv").write_text(WORKSHEET.replace("Anna Lee", "Anna_Lee"))
    told = ("--format", "moodle", "--from", graded, "--roster", tmp_path / "worksheet.csv")
    refused = course(*told)
    assert refused.exit_code == 2
    assert "choose one with --exercise NAME" in " ".join(refused.output.replace("│", " ").split())

    done = course(*told, "--exercise", "battery_service")
    assert done.exit_code == 0, done.output
    with zipfile.ZipFile(graded / "exports/moodle/battery_service_feedback.zip") as archive:
        pages = {name: archive.read(name).decode() for name in archive.namelist()}
    assert list(pages) == [
        "Anna-Lee_9001_assignsubmission_file_battery_service.html",
        "bert@x.org_9002_assignsubmission_file_battery_service.html",
    ]
    for page in pages.values():
        assert "The server answers in time" in page
        assert set(re.findall(r'(?:href|src)="(.)', page)) <= {"#"}, "it needs no other file"
        assert not [word for word in SECRETS if word in page]
    again = course(*told, "--exercise", "battery_service", "--out", tmp_path / "again")
    assert again.exit_code == 0
    zips = [
        folder / "battery_service_feedback.zip" for folder in (graded / "exports/moodle", tmp_path / "again")
    ]
    assert zips[0].read_bytes() == zips[1].read_bytes()


def test_without_a_worksheet_or_pages_it_says_why_moodle_gets_no_feedback_files(tmp_path: Path) -> None:
    graded = graded_folder(tmp_path / "graded", replace(ANNA, student="Anna Lee-9001"))
    said = course("--format", "moodle", "--from", graded).output
    assert "no zip of feedback files" in said
    (tmp_path / "worksheet.csv").write_text(WORKSHEET)
    done = course("--format", "moodle", "--from", graded, "--roster", tmp_path / "worksheet.csv")
    assert "the grades' folder has no page: Anna Lee-9001" in " ".join(done.output.split())
    assert files(graded / "exports/moodle") == ["battery_service.csv"]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("--format", "csv", "--from", "nowhere"), "grade first"),
        (("--format", "blackboard"), "blackboard"),
        (("--format", "canvas", "--assignment", "nothing=1"), "expected EXERCISE=ID"),
        (("--format", "canvas", "--roster", "nowhere.csv"), "nowhere.csv"),
        (("--format", "csv", "--hidden", "maybe"), "maybe"),
    ],
)
def test_unusable_arguments_are_refused_with_what_to_do(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, arguments: tuple[str, ...], said: str
) -> None:
    graded_folder(tmp_path / "graded", ANNA)
    monkeypatch.chdir(tmp_path)
    done = course(*arguments)
    assert done.exit_code == 2
    assert said in done.output


@pytest.mark.parametrize("content", ["", "[]", "[1]", '{"exercise": 1}', '[{"checks": 3}]'])
def test_a_file_that_holds_no_grades_is_named(tmp_path: Path, content: str) -> None:
    (tmp_path / "grades.json").write_text(content)
    done = course("--format", "csv", "--from", tmp_path)
    assert done.exit_code == 2
    assert "grades.json" in done.output.replace("\n", "")
