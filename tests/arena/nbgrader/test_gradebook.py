"""Verdicts become scores in nbgrader's gradebook and pages for students, cell by cell."""

from __future__ import annotations

import dataclasses
import html
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from made_up_grades import FAILED, SOLUTIONS, grade_of
from nbgrader.api import Gradebook, MissingEntry
from traitlets.config import PyFileConfigLoader

from autograder.classroom.nbgrader_bridge import course_folder, generated_cells
from autograder.classroom.nbgrader_bridge.course_folder import (
    NbgraderError,
    StudentCodeWouldRun,
    call,
    open_course,
)
from autograder.classroom.nbgrader_bridge.gradebook import CourseGradebook, Entry, record
from autograder.engine.exercise import load_exercise

SOURCES = {"battery_service.py": "print('a program')\n"}
EXERCISE = load_exercise("battery_service", hidden=True)
HIDDEN = [check for check in EXERCISE.checks if check.hidden]


def submission(course, student):
    """Score, maximum, each cell's points, and whether a person must mark it, from the database."""
    with Gradebook(f"sqlite:///{course / 'gradebook.db'}") as db:
        notebook = db.find_submission_notebook("battery_service", "battery_service", student)
        cells = {grade.name: grade.auto_score for grade in notebook.grades}
        return notebook.score, notebook.max_score, cells, notebook.needs_manual_grade


def test_each_check_is_worth_its_points(gradebook, course):
    grade = grade_of("anna", says_when_it_knows_nothing=FAILED, follows_the_battery=FAILED)
    gradebook.enter(Entry(grade, SOURCES))
    score, highest, cells, needs_person = submission(course, "anna")
    assert (score, highest) == (grade.score, grade.max_score)
    assert 0 < score < highest
    assert cells["says_when_it_knows_nothing"] == 0
    assert cells["answers_with_the_last_message"] == 1
    assert cells["hidden_1"] == HIDDEN[0].points
    assert not needs_person


def test_full_marks_and_none(gradebook, course):
    everything = {check.id: FAILED for check in EXERCISE.checks}
    gradebook.enter(Entry(grade_of("best"), SOURCES))
    gradebook.enter(Entry(grade_of("worst", **everything), SOURCES))
    best, worst = submission(course, "best"), submission(course, "worst")
    assert best[0] == best[1] > 0
    assert worst[0] == 0


def test_grading_again_replaces_the_score(gradebook, course):
    gradebook.enter(Entry(grade_of("anna", ends_cleanly=FAILED), SOURCES))
    gradebook.enter(Entry(grade_of("anna"), SOURCES))
    score, highest, _, _ = submission(course, "anna")
    assert score == highest


def test_late_work_never_has_less_than_no_points(gradebook):
    everything = {check.id: FAILED for check in EXERCISE.checks}
    late = Entry(grade_of("anna", **everything), SOURCES, late_points=3.0)
    page = gradebook.enter(late)
    assert "(Score: 0.0 / " in page.read_text()
    written = page.stat().st_mtime_ns
    assert gradebook.enter(late).stat().st_mtime_ns == written


def test_unchanged_grades_are_not_entered_again_but_new_ones_are(gradebook, course):
    entries = [
        Entry(grade_of("anna"), SOURCES),
        Entry(grade_of("anna"), SOURCES),
        Entry(grade_of("anna", ends_cleanly=FAILED), SOURCES),
        Entry(grade_of("anna", ends_cleanly=FAILED), {"battery_service.py": "# another program\n"}),
        Entry(
            grade_of("anna", ends_cleanly=FAILED),
            {"battery_service.py": "# another program\n"},
            timestamp="2026-03-01 12:00:00 UTC",
        ),
    ]
    made = [gradebook.enter(entry).stat().st_mtime_ns for entry in entries]
    assert made[0] == made[1] < made[2] < made[3] < made[4]


def test_a_gradebook_that_was_lost_is_made_again(gradebook, course):
    gradebook.enter(Entry(grade_of("anna"), SOURCES))
    (course / "gradebook.db").unlink()
    CourseGradebook(course, SOLUTIONS).enter(Entry(grade_of("anna"), SOURCES))
    score, highest, _, _ = submission(course, "anna")
    assert score == highest


def test_manual_decisions_are_kept(gradebook, course):
    gradebook.enter(Entry(grade_of("anna", ends_cleanly=FAILED), SOURCES))
    with Gradebook(f"sqlite:///{course / 'gradebook.db'}") as db:
        db.find_grade("ends_cleanly", "battery_service", "battery_service", "anna").manual_score = 1
        db.find_comment(
            "solution", "battery_service", "battery_service", "anna"
        ).manual_comment = "well argued"
        db.db.commit()
    page = gradebook.enter(Entry(grade_of("anna", ends_cleanly=FAILED, server_appears=FAILED), SOURCES))
    score, highest, _, _ = submission(course, "anna")
    assert score == highest - 1
    assert "well argued" in page.read_text()


def test_a_gradebook_with_submissions_says_why_it_cannot_take_other_checks(gradebook, course, monkeypatch):
    gradebook.enter(Entry(grade_of("anna"), SOURCES))
    fewer = dataclasses.replace(EXERCISE, checks=EXERCISE.checks[:-1])
    monkeypatch.setattr(generated_cells, "load_exercise", lambda name, hidden: fewer)
    with pytest.raises(NbgraderError, match=r"Cannot add or remove cells.*give another folder"):
        CourseGradebook(course, SOLUTIONS).enter(Entry(grade_of("bert"), SOURCES))


@pytest.mark.parametrize(("check", "points"), [("server_appears", 99), ("ends_cleanly", -5)])
def test_points_outside_of_what_a_cell_is_worth_are_refused(gradebook, course, check, points):
    with pytest.raises(NbgraderError, match=f"'{check}' cannot have {points} of"):
        gradebook.enter(Entry(grade_of("anna", **{check: {"points": points}}), SOURCES))
    assert all(score is None for score in submission(course, "anna")[2].values())


def test_an_ungraded_submission_has_no_score_and_nbgrader_cannot_add_one(gradebook, course):
    broken = {"status": "error", "points": 0, "help": "Not graded: the arena could not start"}
    assert gradebook.enter(Entry(grade_of("anna", server_appears=broken), SOURCES)) is None
    gradebook.enter(Entry(grade_of("bert"), SOURCES))
    with pytest.raises(MissingEntry):
        submission(course, "anna")
    # An instructor clicks "Autograde" in formgrader although the submission was graded already.
    (course / "submitted/bert").rename(course / "submitted/anna")
    with pytest.raises(NbgraderError, match="anna's battery_service was not graded"):
        call(open_course(course).autograde, "battery_service", "anna")
    assert not list((course / "autograded/anna").rglob("*.ipynb"))
    assert all(score is None for score in submission(course, "anna")[2].values())


def test_autograding_again_from_formgrader_enters_the_same_verdicts(gradebook, course):
    gradebook.enter(Entry(grade_of("anna", ends_cleanly=FAILED), SOURCES))
    before = submission(course, "anna")
    call(open_course(course).autograde, "battery_service", "anna")
    assert submission(course, "anna") == before


def test_without_isolation_hidden_cells_wait_for_a_person(gradebook, course):
    grade = grade_of("anna", hidden=False)
    gradebook.enter(Entry(grade, SOURCES))
    score, highest, cells, needs_person = submission(course, "anna")
    assert score == grade.score < highest
    assert cells["hidden_1"] is None
    assert needs_person


def test_feedback_says_what_was_expected_what_was_seen_and_what_to_do(gradebook):
    log = "   3.10 s  it printed this"
    page = gradebook.enter(Entry(grade_of("anna", follows_the_battery=FAILED | {"log": log}), SOURCES))
    text = page.read_text()
    for words in (
        "Expected: what should be",
        "Observed: what was",
        "Next: what to do",
        "it printed this",
        "At 1.5 s.",
    ):
        assert words in text
    assert "program" in text


def test_students_see_only_whether_hidden_checks_passed(gradebook, course):
    secret = FAILED | {"expected": "SECRET-1", "observed": "SECRET-2", "help": "SECRET-3", "log": "SECRET-4"}
    page = gradebook.enter(Entry(grade_of("anna", **{check.id: secret for check in HIDDEN}), SOURCES))
    shown = page.read_text() + (course / "autograded/anna/battery_service/battery_service.ipynb").read_text()
    assert "SECRET" not in shown
    for check in HIDDEN:
        assert check.id not in shown
        assert check.title not in shown
    assert "hidden_1" in shown
    # The instructor's record has everything.
    assert "SECRET-4" in (course / "records/anna.json").read_text()


def test_output_of_a_node_is_escaped_on_the_page(gradebook):
    attack = "<script>alert('owned')</script>"
    grade = grade_of("anna", follows_the_battery=FAILED | {"log": attack, "observed": attack})
    text = gradebook.enter(Entry(grade, {"battery_service.py": f"# {attack}\n"})).read_text()
    assert "owned" in text
    assert attack not in text


def test_a_valid_time_of_handing_in_is_taken_over(gradebook, course):
    gradebook.enter(Entry(grade_of("anna"), SOURCES, timestamp="2026-03-01 12:00:00 UTC"))
    with Gradebook(f"sqlite:///{course / 'gradebook.db'}") as db:
        assert db.find_submission("battery_service", "anna").timestamp.isoformat() == "2026-03-01T12:00:00"


def test_a_students_record_keeps_one_grade_an_exercise(course):
    record(course, grade_of("anna", "cancellable_walk"))
    record(course, grade_of("anna", ends_cleanly=FAILED))
    record(course, grade_of("anna"))
    records = json.loads((course / "records/anna.json").read_text())
    assert [(grade["exercise"], grade["score"] == grade["max_score"]) for grade in records] == [
        ("battery_service", True),
        ("cancellable_walk", True),
    ]


def test_each_of_several_files_is_shown_in_its_own_cell(gradebook):
    sources = {"GetBatteryStatus.srv": "---\nbool of_the_service\n"}
    page = gradebook.enter(Entry(grade_of("anna", "interfaces"), sources)).read_text()
    assert "of_the_service" in page
    assert "This file was not handed in." in page


def test_a_reason_makes_a_grade_not_graded_and_removes_the_page_of_an_earlier_grade(gradebook):
    page = gradebook.enter(Entry(grade_of("anna"), SOURCES))
    grade = dataclasses.replace(grade_of("anna"), reason="the machine was too busy")
    assert gradebook.enter(Entry(grade, SOURCES)) is None
    assert not page.exists()


def test_a_course_that_would_execute_submissions_is_not_opened(course, monkeypatch):
    monkeypatch.setitem(
        course_folder._OPTIONS, "Autograde.autograde_preprocessors", ["nbgrader.preprocessors.Execute"]
    )
    with pytest.raises(StudentCodeWouldRun, match=r"nbgrader\.preprocessors\.Execute"):
        open_course(course)


def test_the_written_configuration_is_the_one_we_grade_with(gradebook, course):
    config = PyFileConfigLoader(course_folder.CONFIG_FILE, path=str(course)).load_config()
    assert config.Autograde.autograde_preprocessors == course_folder.AUTOGRADE_PREPROCESSORS
    assert config.GenerateFeedback.preprocessors == course_folder.FEEDBACK_PREPROCESSORS
    assert config.SanitizeHTML.enabled is True
    assert config.VerdictOutputs.records == "records"


def test_the_feedback_page_lists_each_check_by_its_title(gradebook, course):
    gradebook.enter(Entry(grade_of("anna", follows_the_battery=FAILED), SOURCES))
    made = {"ours": feedback_list(course), "nbgrader's own command": []}
    page(course).unlink()
    subprocess.run(
        [Path(sys.executable).with_name("nbgrader"), "generate_feedback", "battery_service", "--force"],
        cwd=course,
        env={**os.environ, "JUPYTER_CONFIG_DIR": str(course / "jupyter")},
        check=True,
        capture_output=True,
    )
    made["nbgrader's own command"] = feedback_list(course)

    numbers = {check.id: number for number, check in enumerate(HIDDEN, start=1)}
    titles = [
        f"Hidden check {numbers[check.id]}" if check.hidden else check.title for check in EXERCISE.checks
    ]
    for maker, listed in made.items():
        assert [title for title, _ in listed] == titles, maker
        scores = dict(listed)
        follows = next(check for check in EXERCISE.checks if check.id == "follows_the_battery")
        assert scores[follows.title] == f"(Score: 0.0 / {float(follows.points)})", maker
    text = page(course).read_text()
    assert "Test cell" not in text
    for check in EXERCISE.checks:
        assert (check.title in text) is not check.hidden


def page(course):
    return course / "feedback/anna/battery_service/battery_service.html"


def feedback_list(course):
    """The title and the score in each line of the list at the top of the page; each link leads somewhere."""
    text = page(course).read_text()
    toc = text[text.index('<div id="toc">') : text.index("</ol>")]
    lines = re.findall(r'<li><a href="#([^"]+)">(.*?)</a>\s*(.*?)</li>', toc, re.DOTALL)
    assert all(f'name="{anchor}"' in text for anchor, _, _ in lines)
    return [(html.unescape(title), score) for _, title, score in lines]
