"""The formats with a table of the class, read back by the platforms' own rules."""

from __future__ import annotations

import csv
import io
from dataclasses import replace
from pathlib import Path

import pytest
from graded_class import ANNA, BERT, CLASS, CLEO, DORA, HOSTILE, OPTIONS, SECRETS, grade, visible

from autograder.engine.verdict import Grade
from autograder.export.formats import Export, export
from autograder.export.published import UnusableBatch
from autograder.export.tables import text_cell

CANVAS = """Student,ID,SIS User ID,SIS Login ID,Section,battery_service (4711),Other (1)
    Points Possible,,,,,5,10
"Lee, Anna",101,s1,anna,A,,3
"=cmd|' /C calc'!A0",102,s2,bert,B,,
"Kim, Cleo",103,s3,cleo,B,,
"""
WORKSHEET = """Identifier,Full name,Email address,Status,Grade,Maximum grade,Last modified (grade),Feedback comments
Participant 9001,Anna Lee,anna@x.org,Submitted,,5.00,-,
Participant 9002,Bert O'Neil,bert@x.org,Submitted,,5.00,-,
"""
CANVAS_OPTIONS = replace(OPTIONS, assignments={"battery_service": "4711", "arm_architecture": "4712"})
SAME = grade("bert", visible("failed"), *ANNA.checks[1:])  # of as many points as Anna's


def rows(text: str) -> list[list[str]]:
    return list(csv.reader(io.StringIO(text)))


def of_canvas(text: str) -> tuple[str, dict[str, float]]:
    """What Canvas would import: the assignment's id, and a score for each student's ID."""
    heading, points, *students = rows(text)
    assert heading[:2] == ["Student", "ID"]
    assert heading[-2] == "Section"
    assert "Points Possible" in points[0]
    float(points[-1])
    assert all(len(row) == len(heading) for row in students)
    return heading[-1], {row[1]: float(row[-1]) for row in students}


def roster(folder: Path, text: str) -> Path:
    path = folder / "roster.csv"
    path.write_text(text, encoding="utf-8-sig")
    return path


def whys(made: Export) -> dict[str, str]:
    return {left.student: left.why for left in made.left_out}


def test_the_table_of_the_class_has_a_row_for_each_score_and_none_for_the_others() -> None:
    made = export("csv", CLASS, OPTIONS)
    table = list(csv.DictReader(io.StringIO(made.files["grades.csv"])))
    assert [(row["student_id"], row["score"], row["max_score"]) for row in table] == [
        ("dora", "2.5", "4"),
        ("anna", "5", "5"),
        ("bert", "0", "6"),
    ]
    assert [(row["hidden_score"], row["hidden_max_score"]) for row in table] == [
        ("0", "0"),
        ("2", "2"),
        ("0", "2"),
    ]
    assert whys(made) == {"cleo": "not graded", "emil": "not marked yet"}


def test_canvas_gets_a_file_an_exercise_so_that_no_cell_is_empty(tmp_path: Path) -> None:
    options = replace(CANVAS_OPTIONS, roster=roster(tmp_path, CANVAS))
    made = export("canvas", [ANNA, SAME, CLEO], options)
    assert of_canvas(made.files["battery_service.csv"]) == (
        "battery_service (4711)",
        {"101": 5.0, "102": 2.0},
    )
    assert list(made.files) == ["battery_service.csv"]
    assert rows(made.files["battery_service.csv"])[3][0] == "'=cmd|' /C calc'!A0"
    assert whys(made) == {"cleo": "not graded"}


def test_canvas_without_a_roster_takes_names_for_logins_and_says_so() -> None:
    made = export("canvas", [ANNA, replace(SAME, student="bert-102")], OPTIONS)
    heading, points, *students = rows(made.files["battery_service.csv"])
    assert heading == ["Student", "ID", "SIS User ID", "SIS Login ID", "Section", "battery_service"]
    assert (points[0], points[-1]) == ("    Points Possible", "5")
    assert students == [["anna", "", "", "anna", "", "5"], ["bert-102", "", "", "bert-102", "", "2"]]
    assert "--assignment battery_service=ID" in made.notes[0]
    assert "--roster FILE" in made.notes[1]
    named = export("canvas", [ANNA], CANVAS_OPTIONS)
    assert rows(named.files["battery_service.csv"])[0][-1] == "battery_service (4711)"
    with pytest.raises(UnusableBatch, match="expected a number"):
        export("canvas", [ANNA], replace(OPTIONS, assignments={"battery_service": "hw1"}))


def test_canvas_students_are_found_by_the_number_of_their_download(tmp_path: Path) -> None:
    options = replace(OPTIONS, roster=roster(tmp_path, CANVAS))
    names = ["leeanna-101", "nobody-999", "kimcleo-101"]
    made = export("canvas", [replace(ANNA, student=name) for name in names], options)
    assert of_canvas(made.files["battery_service.csv"])[1] == {"101": 5.0}
    assert all(left.has_score for left in made.left_out)
    assert "no such student" in whys(made)["nobody-999"]
    assert "number 101 is Lee, Anna's" in whys(made)["kimcleo-101"]


def test_another_number_of_points_on_the_platform_is_refused(tmp_path: Path) -> None:
    options = replace(OPTIONS, roster=roster(tmp_path, CANVAS.replace(",5,10", ",100,10")))
    with pytest.raises(UnusableBatch, match="has 100 points, and battery_service 5"):
        export("canvas", [ANNA], options)
    moodle = replace(OPTIONS, roster=roster(tmp_path, WORKSHEET.replace("5.00", "100.00")))
    with pytest.raises(UnusableBatch, match=r"Maximum grade is 100\.00 and battery_service has 5"):
        export("moodle", [replace(ANNA, student="Anna Lee-9001")], moodle)


@pytest.mark.parametrize(
    ("students", "key"), [(("anna@x.org", "Bert@x.org"), "useremail"), (("2101", "2102"), "useridnumber")]
)
def test_moodle_finds_students_by_address_or_number(students: tuple[str, str], key: str) -> None:
    grades = [replace(one, student=name) for one, name in zip((ANNA, BERT), students, strict=True)]
    made = export("moodle", [*grades, CLEO], OPTIONS)
    table = list(csv.DictReader(io.StringIO(made.files["battery_service.csv"])))
    assert [(row[key], row["battery_service"]) for row in table] == sorted(
        [(students[0], "5"), (students[1], "0")]
    )


def test_moodles_map_of_names_is_used(tmp_path: Path) -> None:
    path = roster(tmp_path, "student,useridnumber\nanna,2101\nbert,=2102\n")
    made = export("moodle", [ANNA, BERT, DORA], replace(OPTIONS, roster=path))
    assert [row[0] for row in rows(made.files["battery_service.csv"])] == ["useridnumber", "2101"]
    assert "would be a formula" in whys(made)["bert"]
    assert "no such student" in whys(made)["dora"]
    assert "arm_architecture.csv" not in made.files


def test_moodles_worksheet_is_handed_back_with_grades_and_only_the_rows_that_have_one(tmp_path: Path) -> None:
    grades = [replace(ANNA, student="Anna Lee-9001"), replace(CLEO, student="bert@x.org")]
    made = export("moodle", grades, replace(OPTIONS, roster=roster(tmp_path, WORKSHEET)))
    (row,) = csv.DictReader(io.StringIO(made.files["battery_service.csv"]))
    assert list(row) == WORKSHEET.splitlines()[0].split(",")
    assert (row["Identifier"], row["Grade"], row["Last modified (grade)"]) == ("Participant 9001", "5", "-")


def test_moodles_feedback_is_escaped_and_silent_about_hidden_checks() -> None:
    made = export("moodle", [replace(BERT, student="2102")], OPTIONS)
    words = rows(made.files["battery_service.csv"])[1][2]
    assert "&lt;script&gt;" in words
    assert "<script>" not in words
    assert "hidden checks: 0 of 2 points" in words
    assert [secret for secret in SECRETS if secret in words] == []


def test_names_of_two_kinds_are_refused() -> None:
    with pytest.raises(UnusableBatch, match="--roster"):
        export("moodle", [replace(ANNA, student="anna@x.org"), BERT], OPTIONS)


@pytest.mark.parametrize("text", ["=1+1", "+1", "-1", "@SUM(A1)", "  =1", "\t=1", "\n=1", "=1", HOSTILE])
def test_no_text_is_a_formula(text: str) -> None:
    assert text_cell(text).startswith("'")


@pytest.mark.parametrize("text", ["", "-", "Grüße 机器人", "a=1", "O'Neil", "1.5"])
def test_other_text_stays_as_it_is(text: str) -> None:
    assert text_cell(text) == text


def test_a_name_that_is_a_formula_stays_text_in_the_table() -> None:
    made = export("csv", [replace(ANNA, student="@SUM(A1)".replace("(", "_").replace(")", "_"))], OPTIONS)
    assert rows(made.files["grades.csv"])[1][0] == "'@SUM_A1_"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "is empty"),
        ("Name,Mail\nanna,a@x\n", "expected the export of Canvas"),
        ("Student,ID\nanna,1\n", "with Student, ID and Section"),
    ],
)
def test_a_roster_that_is_none_is_refused(tmp_path: Path, text: str, said: str) -> None:
    with pytest.raises(UnusableBatch, match=said):
        export("canvas", [ANNA], replace(OPTIONS, roster=roster(tmp_path, text)))


def test_the_same_name_twice_in_a_roster_is_left_to_a_person(tmp_path: Path) -> None:
    twice = CANVAS + '"Lee, Anna",104,s4,anna,A,,3\n'
    made = export("canvas", [ANNA], replace(OPTIONS, roster=roster(tmp_path, twice)))
    assert "stands in 2 rows" in whys(made)["anna"]


def test_grades_without_any_score_make_no_table() -> None:
    unscored: list[Grade] = [CLEO]
    for name in ("canvas", "moodle"):
        assert not export(name, unscored, OPTIONS).files
