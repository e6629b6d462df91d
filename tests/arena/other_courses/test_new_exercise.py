"""`course new` makes exercises that pass their own audit, and the page about it leads to a real one."""

from __future__ import annotations

import zipfile
from pathlib import Path

import pytest
from course_command import COURSE, course
from page import carry_out, steps

from autograder.classroom.new_exercise.make import KINDS

ROOT = Path(__file__).resolve().parents[3]


def test_there_is_a_kind_for_whatever_students_write():
    assert KINDS == ("action", "client", "program", "quiz", "service")


@pytest.mark.parametrize("kind", KINDS)
def test_a_new_exercise_passes_its_own_audit(tmp_path, kind):
    tasks = tmp_path / "tasks"
    made = course("new", "first_steps", "--kind", kind, "--course", tasks)
    assert made.returncode == 0, made.stdout + made.stderr
    assert "./course audit first_steps" in made.stdout
    audited = course("audit", "first_steps", "--course", tasks)
    assert audited.returncode == 0, audited.stdout + audited.stderr
    assert "must catch 0" not in audited.stdout  # every check has a submission that it must catch
    assert course("release", "--check", "--course", tasks).returncode == 0
    starter = (tmp_path / "exercises/first_steps/first_steps.ipynb").read_text()
    assert "# YOUR CODE HERE" in starter


@pytest.mark.parametrize("name", ["Upper", "1st", "with-dash", "class", "../elsewhere"])
def test_a_name_that_is_none_is_refused(tmp_path, name):
    refused = course("new", name, "--kind", "quiz", "--course", tmp_path / "tasks")
    assert refused.returncode == 2
    assert "cannot be an exercise's name" in refused.stdout
    assert not (tmp_path / "tasks").exists()


def test_an_existing_exercise_is_not_changed(tmp_path):
    mine = tmp_path / "tasks/counting/checks.py"
    mine.parent.mkdir(parents=True)
    mine.write_text("my own work")
    assert course("new", "counting", "--kind", "quiz", "--course", tmp_path / "tasks").returncode == 2
    assert mine.read_text() == "my own work"


def test_the_page_leads_to_an_exercise_that_is_graded(tmp_path):
    (tmp_path / "course").symlink_to(COURSE)
    notebook = tmp_path / "tasks/is_upright/is_upright.ipynb"
    printed = [carry_out(step, tmp_path, notebook) for step in steps(ROOT / "docs/write_an_exercise.md")]
    audit = next(text for text in reversed(printed) if "kills" in text)
    assert "kills: 5 of 5" in audit
    assert "false failures: 0 in 1" in audit
    released = (tmp_path / "exercises/is_upright/is_upright.ipynb").read_text()
    assert "says_when_it_has_fallen" in released
    assert "mode in UPRIGHT" not in released
    with zipfile.ZipFile(tmp_path / "students.zip") as archive:
        names = [name for name in archive.namelist() if "is_upright" in name]
    assert sorted(Path(name).name for name in names) == [
        "checks.py",
        "is_upright.ipynb",
        "model.py",
        "scenarios.py",
    ]
