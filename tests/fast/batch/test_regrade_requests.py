"""`course requests`: forms and tables, the second run, the draft of the reply, and the state that a person writes."""

from __future__ import annotations

import json
import shutil
from dataclasses import replace
from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from autograder.classroom.batch.records import read_grades
from autograder.classroom.regrade_requests import Evidence, RegradeRequest
from autograder.engine.exercise import exercises_folder
from course_cli.app import app

FORM = "student: ada\nexercise: patterns\ncheck: {check}\nwhy: I think\nit is right.\n"


@pytest.fixture(scope="module")
def graded(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A class with one graded submission, which loses points."""
    folder = tmp_path_factory.mktemp("class")
    work = folder / "submitted/ada/patterns"
    work.mkdir(parents=True)
    text = (exercises_folder() / "patterns/known/correct/as_a_node.py").read_text()
    (work / "patterns.py").write_text(text.replace("TA SB", "SA SB"))
    command = ["grade", str(folder / "submitted"), "--out", str(folder / "graded"), "--jobs", "1"]
    assert CliRunner().invoke(app("grade"), command).exit_code == 0
    return folder / "graded"


def ask(inbox: Path, graded: Path) -> Result:
    command = ["requests", str(inbox), "--graded", str(graded), "--out", str(inbox / "out"), "--jobs", "1"]
    return CliRunner().invoke(app("requests"), command)


def lost_check(graded: Path) -> dict[str, str]:
    (grade,) = json.loads((graded / "grades.json").read_text())
    return next(check for check in grade["checks"] if check["status"] == "failed" and not check["hidden"])


def test_drafts_quote_the_second_run_and_a_decision_stays(tmp_path: Path, graded: Path) -> None:
    check = lost_check(graded)
    (record,) = json.loads((graded / "grades.json").read_text())
    hidden = next(each for each in record["checks"] if each["hidden"])
    (tmp_path / "one.md").write_text(FORM.format(check=check["title"]))
    (tmp_path / "two.csv").write_text("Student;Exercise;Check;Why\nada;patterns;Hidden check 1;why?\n")
    before = (graded / "grades.json").read_bytes()

    ran = ask(tmp_path, graded)

    assert ran.exit_code == 0, ran.output
    draft, _, for_you = (tmp_path / "out/1/reply.md").read_text().partition("## For you")
    assert "“I think it is right.”" in draft
    assert f"Observed: {check['observed']}" in draft
    assert "second run: same" in for_you
    secret = (tmp_path / "out/2/reply.md").read_text().partition("## For you")[0]
    assert "The check “Hidden check 1”" in secret
    assert hidden["title"] not in secret
    assert not hidden["observed"] or hidden["observed"] not in secret

    table = tmp_path / "out/requests.csv"
    table.write_text(table.read_text().replace(",open,,", ",refused,Anna,"))
    (tmp_path / "out/1/reply.md").unlink()
    assert ask(tmp_path, graded).exit_code == 0
    assert table.read_text().count(",refused,Anna,") == 2
    assert not (tmp_path / "out/1/reply.md").exists()  # it was not graded a third time
    assert (graded / "grades.json").read_bytes() == before


def test_a_request_about_the_whole_grade_names_no_check_and_a_bad_form_stops_no_other(
    tmp_path: Path, graded: Path
) -> None:
    """The grade was late, and then not graded: neither is a difference between two runs."""
    changed = tmp_path / "graded"
    shutil.copytree(graded, changed)
    (record,) = json.loads((changed / "grades.json").read_text())
    record |= {"late": {"points": 1.3, "reason": "Handed in on Sunday: 1 day late."}}
    (changed / "grades.json").write_text(json.dumps([record]))
    (tmp_path / "a.md").write_text("student: ada\nwhy: it was Friday")
    (tmp_path / "b.md").write_text(FORM.format(check=""))

    late = ask(tmp_path, changed)

    assert late.exit_code == 1
    assert "a.md has no line 'exercise'" in " ".join(late.output.split())
    draft = (tmp_path / "out/1/reply.md").read_text()
    assert "points, as before.\n\nHanded in on Sunday: 1 day late.\n" in draft
    assert "second run: same" in draft

    (changed / "grades.json").write_text(json.dumps([record | {"checks": [], "reason": "no arena"}]))
    (tmp_path / "a.md").write_text(FORM.format(check="Everything").replace("think", "hope"))

    assert ask(tmp_path, changed).exit_code == 0
    assert "points; before: not graded." in (tmp_path / "out/2/reply.md").read_text()


def test_the_draft_names_the_recording_and_the_second_of_the_verdict(graded: Path) -> None:
    (grade,) = read_grades(graded / "grades.json")
    checks = [replace(each, robot_time=3.94) for each in grade.checks]
    check = next(each for each in checks if each.status == "failed" and not each.hidden)
    request = RegradeRequest(1, "ada", "patterns", check.id, "")

    reply = Evidence(request, grade, replace(grade, checks=checks), [Path("out/O'Neill/walk.mcap")]).reply()

    assert f"Observed: {check.observed} (at 3.9 s)" in reply
    assert f"""./course replay 'out/O'"'"'Neill/walk.mcap' --around {check.id}""" in reply


def test_a_second_run_that_differs_is_reported(tmp_path: Path, graded: Path) -> None:
    changed = tmp_path / "graded"
    shutil.copytree(graded, changed)
    check = lost_check(graded)
    (record,) = json.loads((changed / "grades.json").read_text())
    for each in record["checks"]:
        if each["id"] == check["id"]:
            each |= {"status": "passed", "points": each["max_points"]}
    (changed / "grades.json").write_text(json.dumps([record]))
    (tmp_path / "one.txt").write_text(FORM.format(check=check["id"]))

    ran = ask(tmp_path, changed)

    assert ran.exit_code == 1
    table = (tmp_path / "out/requests.csv").read_text()
    assert f"DIFFERS: {check['id']}: passed before, failed now" in table
    assert "please report it" in (tmp_path / "out/1/reply.md").read_text()


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("a.md", "student: ada\nwhy: because", "has no line 'exercise'"),
        ("a.csv", "student,exercise,why\nada,patterns,x", "has no column 'check'"),
        ("a.md", FORM.format(check="the whole thing"), "has no check 'the whole thing'"),
        ("a.md", FORM.format(check="x").replace("ada", "zoe"), "has no grade of zoe for patterns"),
        (
            "out/requests.csv",
            "number,student,exercise,check,why,state,by,second_run\n1,a,b,c,d,maybe,,",
            "open, answered",
        ),
    ],
)
def test_what_cannot_be_used_is_named(
    tmp_path: Path, graded: Path, name: str, text: str, message: str
) -> None:
    (tmp_path / name).parent.mkdir(exist_ok=True)
    (tmp_path / name).write_text(text)

    ran = ask(tmp_path, graded)

    assert ran.exit_code != 0
    assert message in " ".join((ran.output + str(ran.exception)).split())


def test_a_program_that_has_changed_since_is_not_graded(tmp_path: Path, graded: Path) -> None:
    changed = tmp_path / "graded"
    shutil.copytree(graded, changed)
    (changed / "sources/patterns/ada/patterns.py").write_text("x = 1\n")
    (tmp_path / "one.md").write_text(FORM.format(check=lost_check(graded)["id"]))

    ran = ask(tmp_path, changed)

    assert ran.exit_code == 1
    assert "is not the program that was graded" in " ".join(ran.output.split())
