"""Finding what students have handed in."""

from __future__ import annotations

import json
import os

import pytest
from nbformat.v4 import new_code_cell, new_notebook

from autograder.classroom.batch.collection import NoSubmissions, collect
from autograder.engine.exercise import all_names
from autograder.engine.submission import UnusableSubmission

NOTEBOOK = json.dumps(
    new_notebook(cells=[new_code_cell("%%writefile battery_service.py\nfrom_notebook = 1\n")])
)


def put(path, text="from_file = 1\n"):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)


def only(folder):
    (work,) = collect(folder).works
    return work


@pytest.mark.parametrize(
    ("name", "text", "source"),
    [
        ("anna/battery_service/battery_service.ipynb", NOTEBOOK, "from_notebook = 1\n"),
        ("anna/battery_service/battery_service.py", "from_file = 1\n", "from_file = 1\n"),
        ("anna/battery_service.py", "from_file = 1\n", "from_file = 1\n"),
        ("anna/battery_service.ipynb", NOTEBOOK, "from_notebook = 1\n"),
    ],
)
def test_each_layout_is_found(tmp_path, name, text, source):
    put(tmp_path / name, text)
    work = only(tmp_path)
    assert (work.student, work.exercise) == ("anna", "battery_service")
    assert work.read().sources == {"battery_service.py": source}


def test_the_notebook_counts_not_the_file_it_once_wrote(tmp_path):
    put(tmp_path / "anna/battery_service/battery_service.ipynb", NOTEBOOK)
    put(tmp_path / "anna/battery_service/battery_service.py", "stale = 1\n")
    assert only(tmp_path).read().sources == {"battery_service.py": "from_notebook = 1\n"}


@pytest.mark.parametrize("place", ["anna/interfaces", "anna"])
def test_an_exercise_of_several_files_is_a_folder_that_holds_one_of_them(tmp_path, place):
    put(tmp_path / place / "GetBatteryStatus.srv", "---\n")
    assert only(tmp_path).exercise == "interfaces"
    assert only(tmp_path).read().sources == {"GetBatteryStatus.srv": "---\n"}


def test_a_link_in_place_of_one_of_several_files_is_not_followed(tmp_path):
    (tmp_path / "secret.txt").write_text("secret")
    put(tmp_path / "submitted/anna/interfaces/NavigateToPose.action", "---\n---\n")
    (tmp_path / "submitted/anna/interfaces/GetBatteryStatus.srv").symlink_to(tmp_path / "secret.txt")
    with pytest.raises(UnusableSubmission, match="not an ordinary file"):
        only(tmp_path / "submitted").read()


def test_works_come_in_order_of_student_and_exercise(tmp_path):
    for name in ("zoe/battery_service.py", "anna/cancellable_walk.py", "anna/battery_service.py"):
        put(tmp_path / name)
    assert [(work.student, work.exercise) for work in collect(tmp_path).works] == [
        ("anna", "battery_service"),
        ("anna", "cancellable_walk"),
        ("zoe", "battery_service"),
    ]


@pytest.mark.parametrize("student", ["Zoë O'Neil", "s123456", "a.b@uni.example", "李明", "last, first"])
def test_usual_names_are_taken(tmp_path, student):
    put(tmp_path / student / "battery_service.py")
    assert only(tmp_path).student == student


@pytest.mark.parametrize("student", ["a*", "[ab]", "x<y>", "a\nb", "-rf"])
def test_names_that_would_match_others_or_break_a_page_are_refused_by_name(tmp_path, student):
    put(tmp_path / student / "battery_service.py")
    put(tmp_path / "anna/battery_service.py")
    collection = collect(tmp_path)
    assert [work.student for work in collection.works] == ["anna"]
    assert repr(student) in collection.refused[0]


def test_files_that_are_not_submissions_are_ignored_with_a_reason(tmp_path):
    put(tmp_path / "anna/battery_service.py")
    put(tmp_path / "bert/holiday.py")
    (tmp_path / "cleo").mkdir()
    put(tmp_path / "grades.csv")
    put(tmp_path / ".DS_Store")
    ignored = "\n".join(collect(tmp_path).ignored)
    assert "bert handed in none of the exercises; their folder holds holiday.py" in ignored
    assert "cleo handed in none of the exercises; their folder holds nothing" in ignored
    assert ignored.count(", ".join(all_names())) == 1
    assert "grades.csv" in ignored
    assert "DS_Store" not in ignored


def test_an_empty_folder_for_an_exercise_is_a_submission_that_cannot_be_read(tmp_path):
    (tmp_path / "anna/battery_service").mkdir(parents=True)
    with pytest.raises(UnusableSubmission, match=r"neither battery_service\.ipynb nor battery_service\.py"):
        only(tmp_path).read()


def test_links_out_of_the_folder_are_not_followed(tmp_path):
    put(tmp_path / "secret.txt", "the instructor's")
    (tmp_path / "submitted/anna").mkdir(parents=True)
    (tmp_path / "submitted/anna/battery_service.py").symlink_to(tmp_path / "secret.txt")
    with pytest.raises(UnusableSubmission, match="not an ordinary file"):
        only(tmp_path / "submitted").read()


def test_a_pipe_does_not_hold_up_the_batch(tmp_path):
    (tmp_path / "anna").mkdir()
    os.mkfifo(tmp_path / "anna/battery_service.py")
    with pytest.raises(UnusableSubmission, match="not an ordinary file"):
        only(tmp_path).read()


@pytest.mark.parametrize(
    ("text", "taken"),
    [("2026-03-01 12:00:00 UTC\n", "2026-03-01 12:00:00 UTC"), ("tomorrow", ""), ("", ""), ("x" * 5000, "")],
)
def test_a_submission_time_is_used_only_if_nbgrader_can_read_it(tmp_path, text, taken):
    put(tmp_path / "anna/battery_service/battery_service.py")
    put(tmp_path / "anna/battery_service/timestamp.txt", text)
    assert only(tmp_path).timestamp == taken


@pytest.mark.parametrize(
    ("text", "taken"), [("0f" * 64, "0f" * 64), ("0f" * 65, ""), ("../" * 20, ""), ("é" * 64, "")]
)
def test_a_feedback_secret_is_used_only_if_it_has_nbgraders_format(tmp_path, text, taken):
    put(tmp_path / "anna/battery_service/battery_service.py")
    put(tmp_path / "anna/battery_service/submission_secret.txt", text)
    assert only(tmp_path).secret == taken


def test_the_error_for_a_folder_with_nothing_to_grade_names_the_expected_layout(tmp_path):
    with pytest.raises(NoSubmissions, match="<student>/<exercise>"):
        collect(tmp_path)
    with pytest.raises(NoSubmissions, match="is not a folder"):
        collect(tmp_path / "absent")
