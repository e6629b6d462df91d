"""The formats with a file for each submission: valid, without hidden checks, and without a wrong zero."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Any
from xml.etree import ElementTree as Xml

import pytest
from graded_class import ANNA, BERT, CLASS, CLEO, DORA, EMIL, OPTIONS, SECRETS, grade, visible
from jsonschema import ValidationError, validate
from platform_schemas import SCHEMAS

from autograder.classroom.export.formats import PER_SUBMISSION, export
from autograder.classroom.export.published import UnusableBatch
from autograder.engine.verdict import Grade

WITHOUT_SCORE = [CLEO, EMIL, grade("fred", reason="no arena could start")]


def file_of(name: str, one: Grade, options: Any = OPTIONS) -> str:
    (text,) = export(name, [one], options).files.values()
    return text


def read(name: str, one: Grade, options: Any = OPTIONS) -> Any:
    return json.loads(file_of(name, one, options))


def said_to_students(name: str, one: Grade) -> str:
    """The text of a file that a student can read; for Gradescope without the tests that it hides."""
    if name != "gradescope":
        return file_of(name, one)
    results = read(name, one)
    results["tests"] = [test for test in results.get("tests", []) if test["visibility"] == "visible"]
    return json.dumps(results)


@pytest.mark.parametrize("name", SCHEMAS)
@pytest.mark.parametrize("one", [ANNA, BERT, CLEO, EMIL], ids=lambda one: one.student)
def test_every_file_follows_the_platforms_schema(name: str, one: Grade) -> None:
    for text in export(name, [one], OPTIONS).files.values():
        validate(json.loads(text), SCHEMAS[name])


def test_the_schemas_refuse_what_they_should() -> None:
    for name, schema in SCHEMAS.items():
        with pytest.raises(ValidationError):
            validate(read(name, ANNA) | {"grade": 1}, schema)


@pytest.mark.parametrize("name", PER_SUBMISSION)
@pytest.mark.parametrize("one", CLASS, ids=lambda one: one.student)
def test_nothing_of_a_hidden_check_reaches_students(name: str, one: Grade) -> None:
    if not export(name, [one], OPTIONS).files:
        assert name == "classroom50"
        return
    text = said_to_students(name, one)
    assert [secret for secret in SECRETS if secret in text] == []


@pytest.mark.parametrize("name", [name for name in PER_SUBMISSION if name != "gradescope"])
def test_hidden_checks_are_summed_up(name: str) -> None:
    assert "hidden checks: 2 of 2 points" in file_of(name, ANNA)
    assert "hidden checks: 0 of 2 points" in file_of(name, BERT)


@pytest.mark.parametrize("name", PER_SUBMISSION)
def test_instructors_can_ask_for_everything(name: str) -> None:
    assert "a secret title" in file_of(name, BERT, replace(OPTIONS, hidden="show"))


@pytest.mark.parametrize("one", WITHOUT_SCORE, ids=lambda one: one.student)
def test_a_submission_without_a_score_gets_none_in_any_format(one: Grade) -> None:
    gradescope = read("gradescope", one)
    assert "score" not in gradescope
    assert "tests" not in gradescope
    suite = Xml.fromstring(file_of("junit", one)).find("testsuite")
    assert suite is not None
    assert (suite.get("errors"), suite.get("failures"), suite.get("tests")) == ("1", "0", "1")
    assert len(list(suite.iter("error"))) == 1
    classroom = export("classroom50", [one], OPTIONS)
    assert not classroom.files
    assert [left.has_score for left in classroom.left_out] == [False]


def test_gradescope_gives_the_grades_score_and_keeps_hidden_tests_from_students() -> None:
    results = read("gradescope", BERT)
    assert results["score"] == 0
    assert results["output"] == "hidden checks: 0 of 2 points"
    assert [test["visibility"] for test in results["tests"]] == ["visible", "visible", "hidden"]
    full = read("gradescope", ANNA)
    assert full["score"] == sum(test["score"] for test in full["tests"]) == 5
    assert full["stdout_visibility"] == "hidden"


def test_text_of_students_is_never_interpreted_as_markup() -> None:
    formats = [test["output_format"] for test in read("gradescope", BERT)["tests"]]
    assert set(formats) == {"text"}
    failure = Xml.fromstring(file_of("junit", BERT)).find(".//failure")
    assert failure is not None
    assert failure.text is not None
    assert "<script>alert(1)</script> ]]> \N{REPLACEMENT CHARACTER} “Grüße” 机器人" in failure.text
    for name in PER_SUBMISSION:
        text = file_of(name, BERT)
        text.encode()
        assert not {"\x00", "\x1b", "\\u0000", "\\u001b"} & set(text)


def test_manual_marks_keep_half_points_if_the_platform_supports_them() -> None:
    assert read("gradescope", DORA)["score"] == 2.5
    refused = export("classroom50", [DORA], OPTIONS)
    assert not refused.files
    assert refused.left_out[0].has_score
    assert "2.5 points" in refused.left_out[0].why


def test_the_counts_in_junit_match_its_test_cases() -> None:
    suite = Xml.fromstring(file_of("junit", BERT)).find("testsuite")
    assert suite is not None
    assert (suite.get("tests"), suite.get("failures"), suite.get("errors")) == ("3", "3", "0")
    assert [case.get("classname") for case in suite.iter("testcase")] == ["battery_service"] * 3
    assert {item.get("name"): item.get("value") for item in suite.iter("property")} == {
        "score": "0",
        "max_score": "6",
    }


def test_classroom50_takes_its_jobs_variables_and_otherwise_says_that_a_person_entered_it() -> None:
    by_hand = read("classroom50", ANNA)
    assert by_hand["submission"] == by_hand["commit"] == "submit/manual-2026-03-01T12-30-05Z"
    assert (by_hand["owner"], by_hand["assignment"], by_hand["classroom"]) == (
        "anna",
        "battery_service",
        "robotics",
    )
    assert by_hand["score"] == sum(test["score"] for test in by_hand["tests"]) == 5
    variables = {
        "CLASSROOM": "other",
        "ASSIGNMENT": "hw1",
        "SUBMISSION_TAG": "submit/2026-x",
        "USERNAME": "anna-gh",
        "COMMIT_URL": "https://c",
        "RELEASE_URL": "https://r",
    }
    in_a_job = read("classroom50", ANNA, replace(OPTIONS, classroom="", environment=variables))
    assert [in_a_job[key] for key in ("classroom", "assignment", "submission", "owner", "commit", "review")] == [
        "other", "hw1", "submit/2026-x", "anna-gh", "https://c", "https://c",
    ]  # fmt: skip
    unnamed = export("classroom50", [ANNA], replace(OPTIONS, classroom=""))
    assert "--classroom NAME" in unnamed.notes[0]
    assert '"classroom": "humanoid-course"' in unnamed.files["anna/battery_service/result.json"]


@pytest.mark.parametrize("student", ["../anna", "a/b", "", "-rf", "anna\n", ".hidden"])
def test_names_that_cannot_be_files_are_refused(student: str) -> None:
    with pytest.raises(UnusableBatch, match="is not a valid name of a student"):
        export("gradescope", [replace(ANNA, student=student)], OPTIONS)


def test_two_grades_for_the_same_work_are_refused() -> None:
    with pytest.raises(UnusableBatch, match="two grades"):
        export("gradescope", [ANNA, replace(ANNA, checks=[visible("failed")])], OPTIONS)
