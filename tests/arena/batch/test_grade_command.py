"""`course grade` from notebooks to gradebook, with real arenas."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from bs4 import BeautifulSoup
from markupsafe import escape
from nbgrader.api import Gradebook

from autograder.engine.exercise import load_exercise
from autograder.isolation.availability import available_isolation

ROOT = Path(__file__).resolve().parents[3]
NOTEBOOK = "battery_service/battery_service.ipynb"
PAGE = "battery_service.html"
RIGHT = (ROOT / "solutions/patterns/known/correct/lines_of_text.py").read_text()
CHANGED_PAGES = (("pages", "patterns"), ("pages", "index"), ("instructor", "patterns"))
KEYS = {"exercise", "student", "status", "isolation", "score", "max_score", "reason", "checks"}
CHECK_KEYS = {
    "id",
    "title",
    "status",
    "points",
    "max_points",
    "expected",
    "observed",
    "help",
    "robot_time",
    "log",
}


def course(*arguments: str | Path, **environment: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [Path(sys.executable).with_name("course"), *arguments],
        env={**os.environ, "COLUMNS": "200", **environment},
        capture_output=True,
        text=True,
        check=False,
    )


def hand_in(folder: Path, student: str, content: bytes) -> None:
    path = folder / student / NOTEBOOK
    path.parent.mkdir(parents=True)
    path.write_bytes(content)


def assert_pages(out: Path, right: dict, wrong: dict) -> None:
    """The class page names both students; the failed check has its drawing, also if its grade is of an earlier run."""
    class_page = (out / "class.html").read_text()
    assert f"{right['score']}/{right['max_score']}" in class_page
    failed = next(check for check in wrong["checks"] if check["status"] == "failed" and not check["hidden"])
    page = (out / "pages" / wrong["student"] / PAGE).read_text()
    for html in (class_page, page):
        assert escape(failed["title"]) in html
    assert "<svg" in page
    assert "<svg" not in (out / "pages" / right["student"] / PAGE).read_text()
    assert not [check for check in wrong["checks"] if check["hidden"] and escape(check["title"]) in page]


def assert_recorded(out: Path, first: dict, anna: dict, bert: dict) -> None:
    """The second run used the seed of the first, and its record has the first run's results of both students."""
    second = json.loads((out / "batch.json").read_text())
    assert second["seed"] == first["seed"] == anna["seed"] == bert["seed"]
    assert second["submissions"][:2] == first["submissions"]
    assert (second["state"], second["counts"]) == ("ended", {"graded": 3})
    if anna["isolation"] == "namespaces":
        assert first["arenas"] >= 2
        assert first["processor_seconds"] > 1
    given = (out / "sources/_base/battery_service/battery_service.py").read_text()
    assert given == (out / "sources/battery_service/bert/battery_service.py").read_text()
    assert given != (out / "sources/battery_service/anna/battery_service.py").read_text()
    assert not (out / "sources/battery_service/carl").exists()
    assert str(second["seed"]) in (out / "class.html").read_text()


def points(folder: Path, exercise: str = "battery_service") -> dict[str, float]:
    """Each student's points, from nbgrader's database."""
    with Gradebook(f"sqlite:///{folder / 'gradebook.db'}") as db:
        return {submission.student.id: submission.score for submission in db.assignment_submissions(exercise)}


def class_rows(out: Path) -> dict[str, str]:
    """The rows of the class page's last table, by student."""
    page = BeautifulSoup((out / "class.html").read_text(), "html.parser")
    rows = page.find(id="students").find_next("tbody").find_all("tr")
    return {row.find("th").get_text(): str(row) for row in rows}


def test_the_reference_gets_full_marks_the_starter_some_and_a_second_run_resumes(tmp_path):
    submitted, out = tmp_path / "submitted", tmp_path / "graded"
    hand_in(submitted, "anna", (ROOT / "solutions" / NOTEBOOK).read_bytes())
    hand_in(submitted, "bert", (ROOT / "exercises" / NOTEBOOK).read_bytes())

    first = course("grade", submitted, "--out", out, "--json", tmp_path / "all.json")
    assert first.returncode == 0, first.stdout + first.stderr
    anna, bert = json.loads((tmp_path / "all.json").read_text())
    assert set(anna) >= KEYS
    assert set(anna["checks"][0]) >= CHECK_KEYS
    checks = load_exercise("battery_service", hidden=available_isolation().trusted).checks
    assert [check["id"] for check in anna["checks"]] == [check.id for check in checks]
    assert anna["score"] == anna["max_score"] == sum(check.points for check in checks)
    assert 0 < bert["score"] < bert["max_score"]
    assert points(out) == {"anna": anna["score"], "bert": bert["score"]}
    assert json.loads((out / "records/bert.json").read_text()) == [bert]
    page = (out / "feedback/bert" / NOTEBOOK).with_suffix(".html").read_text()
    failed = next(check for check in bert["checks"] if check["status"] == "failed")
    assert failed["id"] in page
    assert "YOUR CODE HERE" in page
    assert_pages(out, anna, bert)

    kept = json.loads((out / "batch.json").read_text())
    hand_in(submitted, "carl", b"not a notebook")
    second = course("grade", submitted, "--out", out, "--resume")
    assert second.returncode == 0, second.stdout + second.stderr
    assert " ".join(second.stdout.split()).count("(the same program was graded before)") == 2
    assert_pages(out, anna, bert)
    assert "is not a notebook" in (out / "pages/carl" / PAGE).read_text()
    assert json.loads((out / "grades.json").read_text())[:2] == [anna, bert]
    assert_recorded(out, kept, anna, bert)
    carl = json.loads((out / "grades.json").read_text())[2]
    assert (carl["status"], carl["score"]) == ("graded", 0)
    assert "is not a notebook" in carl["checks"][0]["observed"]
    assert points(out)["carl"] == 0


def test_an_essay_waits_for_a_person_and_has_their_points_when_it_is_graded_again(tmp_path):
    essay, out = "arm_architecture", tmp_path / "graded"
    handed_in = tmp_path / f"submitted/anna/{essay}/{essay}.ipynb"
    handed_in.parent.mkdir(parents=True)
    shutil.copyfile(ROOT / f"exercises/{essay}/{essay}.ipynb", handed_in)

    first = course("grade", tmp_path / "submitted", "--out", out)
    assert first.returncode == 0, first.stdout + first.stderr
    assert "1 to be marked by hand" in first.stdout
    (anna,) = json.loads((out / "grades.json").read_text())
    assert (anna["status"], anna["score"], anna["max_score"]) == ("to mark", None, 20)
    assert not (out / "feedback").exists()

    with Gradebook(f"sqlite:///{out / 'gradebook.db'}") as db:
        for grade in db.find_submission_notebook(essay, essay, "anna").grades:  # as formgrader does
            grade.manual_score, grade.needs_manual_grade = 0.5, False
        db.db.commit()
    second = course("grade", tmp_path / "submitted", "--out", out)
    assert second.returncode == 0, second.stdout + second.stderr
    (anna,) = json.loads((out / "grades.json").read_text())
    assert (anna["status"], anna["score"]) == ("graded", 3.5)
    assert {check["status"] for check in anna["checks"]} == {"marked"}
    assert (out / f"feedback/anna/{essay}/{essay}.html").exists()


def test_a_part_that_is_graded_again_leaves_the_rest_and_without_isolation_all_is_marked(tmp_path):
    submitted, out = tmp_path / "submitted", tmp_path / "graded"
    for student, program in (("anna", RIGHT), ("bert", "print()")):
        hand_in(submitted, student, b"not a notebook")
        (submitted / student / "patterns.py").write_text(program)
    first = course("grade", submitted, "--out", out, COURSE_ISOLATION="none")
    assert first.returncode == 0, first.stdout + first.stderr
    assert "No isolation" in first.stdout
    before = {(row["student"], row["exercise"]): row for row in json.loads((out / "grades.json").read_text())}
    assert {row["isolation"] for row in before.values()} == {"untrusted"}
    assert not any(check["hidden"] for row in before.values() for check in row["checks"])
    pages = {path: path.read_bytes() for path in out.glob("*/*/*.html")}
    full = before["anna", "patterns"]["max_score"]
    assert points(out, "patterns") == {"anna": full, "bert": 0}
    rows = class_rows(out)

    for student in ("anna", "bert"):  # what is not requested is not graded
        (submitted / student / "patterns.py").write_text(RIGHT if student == "bert" else "print()")
        (submitted / student / NOTEBOOK).write_bytes(b"still not a notebook")
    part = ("--student", "bert", "--exercise", "patterns")
    again = course("grade", submitted, "--out", out, *part, COURSE_ISOLATION="none")
    assert again.returncode == 0, again.stdout + again.stderr
    after = {(row["student"], row["exercise"]): row for row in json.loads((out / "grades.json").read_text())}
    assert after.pop(("bert", "patterns"))["score"] == full
    assert before.pop(("bert", "patterns"))["score"] == 0
    assert after == before
    assert points(out, "patterns") == {"anna": full, "bert": full}
    changed = {path.relative_to(out).as_posix() for path, page in pages.items() if path.read_bytes() != page}
    assert changed == {f"{top}/bert/{name}.html" for top, name in CHANGED_PAGES}
    assert class_rows(out)["anna"] == rows["anna"]
    assert class_rows(out)["bert"] != rows["bert"]


@pytest.mark.parametrize(
    "make", [lambda folder: None, lambda folder: folder.mkdir()], ids=["absent", "empty"]
)
def test_nothing_to_grade_is_an_unusable_argument(tmp_path, make):
    make(tmp_path / "submitted")
    ran = course("grade", tmp_path / "submitted", "--out", tmp_path / "graded")
    assert ran.returncode == 2
    assert "<student>/<exercise>" in ran.stdout
    assert not (tmp_path / "graded").exists()


def test_a_folder_with_an_unusable_name_is_named_and_the_others_are_graded(tmp_path):
    hand_in(tmp_path / "submitted", "anna", b"not a notebook")
    shutil.copytree(tmp_path / "submitted/anna", tmp_path / "submitted/a*")
    ran = course("grade", tmp_path / "submitted", "--out", tmp_path / "graded")
    assert ran.returncode == 1
    assert "'a*'" in ran.stdout
    assert len(json.loads((tmp_path / "graded/grades.json").read_text())) == 1


def test_shards_are_merged_into_one_gradebook_and_an_absent_one_is_named(tmp_path):
    for student in ("anna", "bert", "carl"):
        hand_in(tmp_path / "submitted", student, b"not a notebook")
    shards = [tmp_path / "shard1", tmp_path / "shard2"]
    for number, shard in enumerate(shards, 1):
        ran = course(
            *("grade", tmp_path / "submitted", "--out", shard, "--shard", f"{number}/2"),
            COURSE_ISOLATION="none",
        )
        assert ran.returncode == 0, ran.stdout + ran.stderr
        assert not (shard / "gradebook.db").exists()

    out = tmp_path / "graded"
    ran = course("merge", *shards, "--out", out, COURSE_ISOLATION="none")
    assert ran.returncode == 0, ran.stdout + ran.stderr
    assert [grade["student"] for grade in json.loads((out / "grades.json").read_text())] == [
        "anna",
        "bert",
        "carl",
    ]
    assert points(out) == dict.fromkeys(("anna", "bert", "carl"), 0)

    partly = course("merge", shards[0], "--out", tmp_path / "partly")
    assert partly.returncode == 1
    records = [json.loads((folder / "batch.json").read_text()) for folder in (*shards, out)]
    assert len({record["seed"] for record in records}) == 1
    assert [len(record["submissions"]) for record in records] == [2, 1, 3]
    assert "missing: shard 2/2 is not among the folders" in partly.stdout
    assert "bert's battery_service has no grade" in partly.stdout
    assert course("merge", *shards, shards[0], "--out", out).returncode == 0  # a duplicate counts once
