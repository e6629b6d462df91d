"""dates.yaml: due times, late rule, extensions, and what each late submission loses."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from nbgrader.api import Gradebook
from typer.testing import CliRunner

from autograder.classroom.dates import Deadlines, read_deadlines
from autograder.engine.exercise import exercises_folder
from autograder.engine.verdict import CheckVerdict, Grade
from course_cli.app import app
from ros_runtime.course_error import CourseError

DUE = "due: {walk_to: 2026-12-04 18:00, walk_client: 2026-12-04}\n"
RULE = "late: {percent_per_day: 10, at_most_percent: 40, grace_minutes: 15}\n"
BUDGET = "late: {percent_per_day: 10, late_days: 2, accepted_days: 5}\n"


def deadlines(folder: Path, text: str) -> Deadlines:
    path = folder / "dates.yaml"
    path.write_text(text)
    read = read_deadlines(None, folder / "submitted")
    assert read
    return read


def grade_of(exercise: str, student: str = "ada") -> Grade:
    return Grade(exercise, student, "namespaces", [CheckVerdict("a", "A", "passed", 20, 30)])


@pytest.mark.parametrize(
    ("text", "timestamp", "score", "reason"),
    [
        (DUE + RULE, "2026-12-04 18:15:00 UTC", 20, ""),
        (DUE + RULE, "2026-12-04 18:16:00 UTC", 17, "1 day late"),
        (DUE + RULE, "2026-12-05 18:16:00 UTC", 14, "2 days late"),
        (DUE + RULE, "2026-12-24 12:00:00 UTC", 8, "at most 40 %"),
        (
            DUE + "late: {percent_per_day: 80}",
            "2026-12-05 12:00:00 UTC",
            0,
            "24, are deducted, but not below 0.",
        ),
        ("timezone: Europe/Vienna\n" + DUE + RULE, "2026-12-04 17:16:00 UTC", 17, "18:16 CET"),
        (
            DUE + RULE + "extensions: {ada: {walk_to: 2026-12-08}}",
            "2026-12-08 23:59:00 UTC",
            20,
            "(extended): in time.",
        ),
        (DUE + RULE + "handed_in: {ada: {walk_to: 2026-12-04 17:00}}", "2026-12-09 12:00:00 UTC", 20, ""),
        (DUE + RULE, "", 20, ""),
        (DUE + BUDGET, "2026-12-06 12:00:00 UTC", 20, "2 of your late days used, 0 of 2 left"),
        (DUE + BUDGET, "2026-12-07 12:00:00 UTC", 17, "1 day × 10 %"),
        (DUE + BUDGET, "2026-12-10 12:00:00 UTC", 0, "accepted until 5 days"),
    ],
)
def test_late_work_loses_what_the_rule_says(
    tmp_path: Path, text: str, timestamp: str, score: float, reason: str
) -> None:
    (found,) = deadlines(tmp_path, text).applied([grade_of("walk_to")], {("ada", "walk_to"): timestamp})

    assert (found.earned, found.score) == (20, score)
    assert reason in found.late.reason if found.late else not reason


def test_late_days_are_used_in_the_order_of_handing_in(tmp_path: Path) -> None:
    timestamps = {
        ("ada", "walk_to"): "2026-12-06 17:00:00 UTC",  # 2 days late, after walk_client
        ("ada", "walk_client"): "2026-12-05 12:00:00 UTC",  # 1 day late
    }

    first, second = deadlines(tmp_path, DUE + BUDGET).applied(
        [grade_of("walk_to"), grade_of("walk_client")], timestamps
    )

    assert (first.score, second.score) == (17, 20)


def test_the_instructor_reads_who_is_late_whose_time_is_unknown_and_who_is_missing(tmp_path: Path) -> None:
    dates = deadlines(tmp_path, DUE + RULE + "extensions: {Zoe Lee: {walk_to: 2026-12-08}}")
    unknown_times = ["Zoe Lee-41", *(f"bob {number}" for number in range(6))]
    timestamps = {("ada", "walk_to"): "2026-12-05 12:00:00 UTC"}
    timestamps |= {(student, "walk_to"): "" for student in unknown_times}
    grades = dates.applied([grade_of(exercise, student) for student, exercise in timestamps], timestamps)

    late, unknown, missing = dates.notes(grades, timestamps)

    assert late.startswith(
        "ada · walk_to: Handed in Sat 05 Dec 2026 12:00 UTC, due Fri 04 Dec 2026 18:00 UTC"
    )
    assert unknown.startswith(
        "walk_to: time unknown, so nothing is deducted: Zoe Lee-41, bob 0, bob 1, bob 2, bob 3"
    )
    assert f" and 2 more; write the times of those who were late to handed_in in {dates.path}" in unknown
    assert missing.endswith("names students without a submission: Zoe Lee (their folder may be Zoe Lee-41)")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("due: {walk_too: 2026-12-04}", "there is no exercise 'walk_too'"),
        ("due: {walk_to: tomorrow}", "due > walk_to: .*found 'tomorrow'"),
        ("late: {percent_per_day: 110}", "late > percent_per_day: .*less than or equal to 100"),
        ("late: {per_day: 10}", "late > per_day: "),
        ("timezone: Vienna", "expected a name such as Europe/Vienna"),
        (
            "extensions:\n  007: {walk_to: 2026-12-08}\n  007: {walk_client: 2026-12-08}",
            "'007' is given twice",
        ),
        ("due: [", "cannot be read"),
    ],
)
def test_a_wrong_entry_is_named_with_what_is_expected(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(CourseError, match=message):
        deadlines(tmp_path, text)


def test_a_class_without_dates_has_none(tmp_path: Path) -> None:
    assert read_deadlines(None, tmp_path / "submitted") is None
    with pytest.raises(CourseError, match="cannot be read"):
        read_deadlines(tmp_path / "missing.yaml", tmp_path)


@pytest.mark.parametrize("second", [[], ["--student", "ben"]])
def test_gradebook_and_pages_follow_the_dates_also_when_these_change(
    tmp_path: Path, second: list[str]
) -> None:
    """Also those of a student who is not graded again."""
    out = tmp_path / "graded"
    correct = exercises_folder() / "patterns/known/correct/as_a_node.py"
    for student in ("ada", "ben"):
        folder = tmp_path / "submitted" / student / "patterns"
        folder.mkdir(parents=True)
        shutil.copy(correct, folder / "patterns.py")
        (folder / "timestamp.txt").write_text("2026-12-05 12:00:00 UTC\n")
    for percent, score, options in ((10, 11.7, []), (20, 10.4, second)):
        (tmp_path / "dates.yaml").write_text(
            f"due: {{patterns: 2026-12-04}}\nlate: {{percent_per_day: {percent}}}\n"
        )
        command = [
            "grade",
            str(tmp_path / "submitted"),
            "--out",
            str(out),
            "--jobs",
            "1",
            "--resume",
            *options,
        ]
        ran = CliRunner().invoke(app("grade"), command)
        assert ran.exit_code == 0, ran.output

        page = (out / "pages/ada/patterns.html").read_text()
        assert f"{score} of 13 points (13 before the deduction for late work)" in page
        assert f"1 day × {percent} %" in page
        assert f"{score}/13 (late, 13 before)" in (out / "pages/ada/index.html").read_text()
        with Gradebook(f"sqlite:///{out / 'gradebook.db'}") as gradebook:
            submission = gradebook.find_submission("patterns", "ada")
            assert submission.score - submission.late_submission_penalty == pytest.approx(score)
        assert "Late submission penalty" in (out / "feedback/ada/patterns/patterns.html").read_text()
