"""A student's progress is counted and shown with a next step."""

from __future__ import annotations

import re
from pathlib import Path

import nbformat
import pytest

import lab
from lab.learning import progress_table as progress
from lab.learning.contents import read_contents
from lab.learning.gap import read_gaps
from lab.learning.prediction import predict
from lab.learning.progress_file import store_entry
from lab.learning.question import read_questions
from ros_runtime.self_checks import (
    FILE,
    LastCheck,
    last_check_of,
    last_checks,
    store_check,
    store_submitted,
    submitted_folders,
)

ROOT = Path(__file__).resolve().parents[3]


@pytest.fixture
def checks(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> dict[str, LastCheck]:
    """The self-checks that were made; the chapters' file of progress is in the present folder."""
    made: dict[str, LastCheck] = {}
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(progress, "CHAPTERS", tmp_path)
    monkeypatch.setattr(progress, "last_checks", lambda: made)
    return made


def row(number: str) -> progress.ChapterProgress:
    return next(row for row in progress.read_progress() if row.chapter.title.startswith(f"{number} "))


def read_chapter(name: str) -> None:
    """Do all of a chapter: predictions, quiz and gaps."""
    for number in range(1, len(read_questions(name, "predictions")) + 1):
        predict(name, number).choose("a")
    for question in read_questions(name, "questions"):
        store_entry(
            "questions", question.text, next(choice.text for choice in question.choices if choice.right)
        )
    for gap in read_gaps(name):
        store_entry("gaps", gap.file, "2026-01-01T10:00:00")


def test_the_contents_are_every_chapter_and_every_exercise() -> None:
    contents = read_contents()
    assert [one.notebook for one in contents] == sorted((ROOT / "chapters").glob("*.ipynb"))
    exercises = [exercise.notebook for one in contents for exercise in one.exercises]
    assert sorted(exercises) == sorted((ROOT / "exercises").glob("*/*.ipynb"))


def test_without_any_progress_a_first_step_is_shown(checks: dict[str, LastCheck]) -> None:
    sentence, notebook = progress.next_step(progress.read_progress())
    assert sentence.startswith("Nothing done yet. Your first step")
    assert notebook.name == "01_robot_and_graph.ipynb"
    assert repr(lab.show_progress()).startswith(sentence)


def test_predictions_answers_and_gaps_are_counted(checks: dict[str, LastCheck]) -> None:
    predict("services", 2).choose("b")
    lab.quiz("services", 1).answer("a")
    lab.quiz("services", 3).answer("b")
    lab.quiz("services", 3).answer("a")  # the last answer counts
    store_entry("gaps", "where_am_i_fixed.py", "2026-01-01T10:00:00")
    store_entry("predictions", "a question that is gone", "a choice")
    parts = row("2").parts
    assert str(parts["Predictions"]).startswith("1/")
    assert re.match(r"2/\d+, \d right", str(parts["Quiz"]))
    assert parts["Gaps"].done == 1
    assert not row("1").begun


def test_the_next_step_goes_through_a_chapter_then_its_exercises(checks: dict[str, LastCheck]) -> None:
    predict("robot_and_graph", 1).choose("a")
    assert progress.next_step(progress.read_progress())[0] == "Go on with"

    read_chapter("robot_and_graph")
    assert progress.next_step(progress.read_progress())[1].stem == "patterns"
    checks["patterns"] = LastCheck(10, 13, "2026-01-01T10:00:00")
    assert progress.next_step(progress.read_progress())[1].stem == "patterns"
    checks["patterns"] = LastCheck(13, 13, "2026-01-01T10:00:00")
    assert progress.next_step(progress.read_progress())[1].stem == "02_services"


def test_the_table_has_a_bar_for_each_part_and_links_that_lead_somewhere(
    checks: dict[str, LastCheck], monkeypatch: pytest.MonkeyPatch
) -> None:
    predict("services", 1).choose("a")
    checks["battery_service"] = LastCheck(5, 7, "2026-11-22T19:40:00")
    monkeypatch.chdir(ROOT)  # the folder of start_here.ipynb
    html = lab.show_progress()._repr_html_()
    assert 'value="5" max="7" aria-label="battery_service: 5 of 7"' in html
    assert "5/7 checks passed, 22 Nov 19:40" in html
    assert 'aria-label="Predictions: 1 of ' in html
    links = re.findall(r'href="([^"]+)"', html)
    assert len(links) > 12
    assert [link for link in links if not (ROOT / link).exists()] == []


def test_the_last_self_check_is_kept_above_the_exercises(tmp_path: Path) -> None:
    file = tmp_path / ".progress.json"
    (tmp_path / "battery_service").mkdir()
    store_check("battery_service", 3, 7, file=file)
    store_check("battery_service", 7, 7, file=file)
    store_check("battery_service", 5, 7, "of an experiment", file=file, for_its_row=False)
    store_check("of_another_course", 1, 1, file=file)
    assert {name: (kept.passed, kept.total) for name, kept in last_checks(file).items()} == {
        "battery_service": (7, 7)
    }
    assert (kept := last_check_of("of an experiment", file))
    assert kept.passed == 5
    assert list((tmp_path / "battery_service").iterdir()) == []
    assert FILE.parent == ROOT / "exercises"


def test_a_file_to_hand_in_is_shown_beside_its_exercise_while_it_is_as_submitted(
    checks: dict[str, LastCheck], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "exercises" / ".progress.json"
    notebook = tmp_path / "hand_in" / "patterns.ipynb"
    for folder in (file.parent, notebook.parent):
        folder.mkdir()
    notebook.write_text("{}")
    store_submitted(notebook, file)
    monkeypatch.setattr(progress, "submitted_folders", lambda: submitted_folders(file))
    assert "patterns: not checked yet; file in hand_in/" in repr(lab.show_progress())
    assert "not checked yet; file in hand_in/</td>" in lab.show_progress()._repr_html_()
    notebook.write_text("{ }")
    assert submitted_folders(file) == {}


@pytest.mark.parametrize("damaged", ["", "[]", '{"checks": 1}', '{"checks": {"battery_service": {}}}'])
def test_a_damaged_file_counts_as_no_check(tmp_path: Path, damaged: str) -> None:
    file = tmp_path / ".progress.json"
    file.write_text(damaged)
    assert last_checks(file) == {}


def test_the_first_page_shows_the_progress_and_is_stored_without_it() -> None:
    page = nbformat.read(ROOT / "start_here.ipynb", as_version=4)
    code = [cell for cell in page.cells if cell.cell_type == "code"]
    assert [cell.source.splitlines()[-1] for cell in code] == ["lab.show_progress()"]
    assert all(cell.outputs == [] and cell.execution_count is None for cell in code)
