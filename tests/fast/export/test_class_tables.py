"""The formats with a table of the class, read back by the platforms' own rules."""

from __future__ import annotations

import csv
import io
from dataclasses import replace
from pathlib import Path

import pytest
from graded_class import (
    ANNA,
    BERT,
    CLASS,
    CLEO,
    DORA,
    HOSTILE,
    OPTIONS,
    SAME,
    SECRETS,
    WORKSHEET,
)

from autograder.classroom.export.formats import Export, export
from autograder.classroom.export.published import UnusableBatch
from autograder.classroom.export.tables import text_cell
from autograder.engine.verdict import Grade

CANVAS = """Student,ID,SIS User ID,SIS Login ID,Section,battery_service (4711),Other (1)
    Points Possible,,,,,5,10
"Lee, Anna",101,s1,anna,A,,3
"=cmd|' /C calc'!A0",102,s2,bert,B,,
"Kim, Cleo",103,s3,cleo,B,,
"""
CANVAS_OPTIONS = replace(OPTIONS, assignments={"battery_service": "4711", "arm_architecture": "4712"})


def rows(text: str) -> list[list[str]]:
    return list(csv.reader(io.StringIO(text)))


def of_canvas(text: str) -> tuple[str, dict[str, float]]:
    """The data that Canvas would import: the assignment's id, and a score for each student's id."""
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


def test_canvas_without_a_roster_uses_names_as_logins_and_prints_it() -> None:
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
    assert "number 101 belongs to Lee, Anna" in whys(made)["kimcleo-101"]


def test_another_number_of_points_on_the_platform_is_refused(tmp_path: Path) -> None:
    options = replace(OPTIONS, roster=roster(tmp_path, CANVAS.replace(",5,10", ",100,10")))
    with pytest.raises(UnusableBatch, match="has 100 points in Canvas, but battery_service has 5"):
        export("canvas", [ANNA], options)
    moodle = replace(OPTIONS, roster=roster(tmp_path, WORKSHEET.replace("5.00", "100.00")))
    with pytest.raises(UnusableBatch, match=r"Maximum grade is 100\.00, but battery_service has 5"):
        export("moodle", [replace(ANNA, student="Anna Lee-9001")], moodle)


def saved(folder: Path, text: str, encoding: str = "utf-8", separator: str = ",") -> Path:
    """Save a table as Excel does, in the code page and with the separator of its user's language."""
    table = io.StringIO(newline="")
    csv.writer(table, delimiter=separator).writerows(rows(text))
    path = folder / "saved.csv"
    path.write_bytes(table.getvalue().encode(encoding))
    return path


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "cp1252"])
@pytest.mark.parametrize("separator", [",", ";", "\t"])
def test_a_gradebook_is_read_as_canvas_and_excel_write_it(
    tmp_path: Path, encoding: str, separator: str
) -> None:
    text = CANVAS.replace("Lee, Anna", "Lée, Ännie").replace(",,5,10", ',,"5,00","10,00"')
    made = export("canvas", [ANNA], replace(OPTIONS, roster=saved(tmp_path, text, encoding, separator)))
    assert rows(made.files["battery_service.csv"])[2][:4] == ["Lée, Ännie", "101", "s1", "anna"]
    assert of_canvas(made.files["battery_service.csv"])[1] == {"101": 5.0}
    assert ["CSV UTF-8" in note for note in made.notes] == ([True] if encoding == "cp1252" else [])


@pytest.mark.parametrize(
    "points",
    ["100.00", "100,00", "1.000,00", "1\N{NO-BREAK SPACE}000,00", "1'000.00", "٥٫٥", "", "-", "viele"],
)
def test_other_points_in_canvas_are_refused_however_they_are_written(tmp_path: Path, points: str) -> None:
    text = CANVAS.replace(",,5,10", f',,"{points}",10')
    with pytest.raises(UnusableBatch, match="export Canvas' gradebook again"):
        export("canvas", [ANNA], replace(OPTIONS, roster=saved(tmp_path, text)))


def test_canvas_may_split_names_and_show_no_points(tmp_path: Path) -> None:
    text = (
        "LastName,FirstName,ID,SIS Login ID,Section,Notes,battery_service (4711)\n,,,,,,Manual Posting\n"
        "    Points Possible,,,,,,5.00\nLee,Anna,101,anna,A,,\n"
    )
    made = export("canvas", [ANNA], replace(OPTIONS, roster=saved(tmp_path, text)))
    assert rows(made.files["battery_service.csv"])[2] == ["Lee, Anna", "101", "anna", "A", "5"]
    unseen = replace(CANVAS_OPTIONS, roster=saved(tmp_path, text.replace("4711", "9")))
    assert (
        "without a roster the points of battery_service (4711) in Canvas are unknown"
        in export("canvas", [ANNA], unseen).notes[0]
    )


def test_anonymous_students_are_left_out_of_gradebooks(tmp_path: Path) -> None:
    made = export(
        "canvas", [replace(ANNA, student="anon_aB3cD")], replace(OPTIONS, roster=roster(tmp_path, CANVAS))
    )
    assert not made.files
    assert "collect and grade a new download" in whys(made)["anon_aB3cD"]


# Moodle's worksheet in the languages, forms and encodings in which it comes: the row of the student as it goes back.
WORKSHEETS = {
    "German, with commas": (
        "utf-8", ",", "Anna Lee-4101",
        'ID,"Vollständiger Name",E-Mail-Adresse,Status,Bewertung,Bestwertung,"Bewertung kann geändert werden",'
        '"Zuletzt geändert (Abgabe)","Feedback als Kommentar"\n'
        '"Teilnehmer/in 4101","Anna Lee",s10,Abgegeben,,"5,00",Ja,"Montag, 5. Oktober 2026, 09:00",\n',
        (4, 8),
    ),
    "Russian, by Excel": (
        "cp1251", ";", "Анна Ли-4101",
        "Идентификатор,Полное имя,Состояние,Оценка,Максимальная оценка,Последнее изменение (оценка),Отзыв\n"
        'Участник4101,Анна Ли,Ответы для оценки,,"5,00",-,\nУчастник4102,Иван,Ответы для оценки,,"5,00",-,\n',
        (3, 6),
    ),
    "Japanese, anonymous, graded before": (
        "utf-16", "\t", "参加者-4101",
        "識別子,ステータス,評点,最大評点,最終更新日時 (評点),フィードバックコメント\n"
        "参加者4101,提出済み,3.00,5.00,2026年 10月 5日 09:00,前の\n参加者4102,提出済み,5.00,5.00,-,\n",
        (2, 5),
    ),
    "French of Canada, in UTF-16 without its mark": (
        "utf-16-le", "\t", "Anna Lee-4101",
        "Identifiant,Nom complet,Note,Note maximale,Note modifiable,Dernière modification (note),Rétroaction\n"
        "Participant 4101,Anna Lee,,5.00,Oui,5 octobre 2026 à 09 h 00,\n",
        (2, 6),
    ),
    "French, with numbers of students, a marker and online text, without feedback": (
        "cp1252", ";", "2101",
        "Identifiant,Nom complet,Numéro d'identification,Statut,Évaluateur,Note,Note maximale,Note modifiable,"
        "Dernière modification (travail remis),Texte en ligne,Dernière modification (note)\n"
        'Participant 4101,Anna Lee,2101,Remis,,,"5,00",Oui,"lundi 5 octobre 2026, 09:00",12,-\n',
        (5, None),
    ),
}  # fmt: skip


@pytest.mark.parametrize("form", WORKSHEETS)
def test_moodles_worksheet_is_filled_in_in_any_language(tmp_path: Path, form: str) -> None:
    encoding, separator, student, text, (grade_column, feedback_column) = WORKSHEETS[form]
    options = replace(OPTIONS, roster=saved(tmp_path, text, encoding, separator))
    made = export("moodle", [replace(ANNA, student=student)], options)
    heading, row = rows(made.files["battery_service.csv"])
    wanted_heading, wanted, *_ = rows(text)
    wanted[grade_column] = "5"
    if feedback_column:
        wanted[feedback_column] = row[feedback_column]
        assert "1 of 1 visible checks passed." in row[feedback_column]
    assert (heading, row) == (wanted_heading, wanted)
    assert any("no column for feedback" in note for note in made.notes) == (feedback_column is None)
    other = replace(
        OPTIONS,
        roster=saved(tmp_path, text.replace("5,00", "50,00").replace("5.00", "50.00"), encoding, separator),
    )
    with pytest.raises(UnusableBatch, match=f"{wanted_heading[grade_column + 1]} is 50"):
        export("moodle", [replace(ANNA, student=student)], other)


def test_a_worksheet_on_a_scale_is_refused(tmp_path: Path) -> None:
    text = (
        'Identifier,Email address,Grade,Scale,Last modified (grade)\nParticipant 1,anna@x.org,,"no\nyes",-\n'
    )
    with pytest.raises(UnusableBatch, match="graded by points"):
        export(
            "moodle", [replace(ANNA, student="anna@x.org")], replace(OPTIONS, roster=saved(tmp_path, text))
        )


def test_a_workbook_is_distinguished_from_a_table_and_excels_first_line_is_skipped(tmp_path: Path) -> None:
    for begins in (b"PK\x03\x04", b"\xd0\xcf\x11\xe0"):
        (tmp_path / "book.csv").write_bytes(begins + b"\x14\x00\xff")
        with pytest.raises(UnusableBatch, match="workbook"):
            export("canvas", [ANNA], replace(OPTIONS, roster=tmp_path / "book.csv"))
    path = saved(tmp_path, CANVAS, separator=";")
    path.write_text("sep=;\n" + path.read_text())
    assert export("canvas", [ANNA], replace(OPTIONS, roster=path)).files


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


def test_moodles_mapping_of_names_is_used(tmp_path: Path) -> None:
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


def test_moodles_feedback_is_escaped_and_omits_hidden_checks() -> None:
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
def test_a_file_that_is_not_a_roster_is_refused(tmp_path: Path, text: str, said: str) -> None:
    with pytest.raises(UnusableBatch, match=said):
        export("canvas", [ANNA], replace(OPTIONS, roster=roster(tmp_path, text)))


def test_a_duplicate_name_in_a_roster_is_reported(tmp_path: Path) -> None:
    twice = CANVAS + '"Lee, Anna",104,s4,anna,A,,3\n'
    made = export("canvas", [ANNA], replace(OPTIONS, roster=roster(tmp_path, twice)))
    assert "is in 2 rows" in whys(made)["anna"]


def test_grades_without_any_score_make_no_table() -> None:
    unscored: list[Grade] = [CLEO]
    for name in ("canvas", "moodle"):
        assert not export(name, unscored, OPTIONS).files
