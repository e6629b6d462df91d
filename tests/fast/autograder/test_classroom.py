"""A class whose grades are known: who hands in what, and what is said of grades that are not as known."""

from __future__ import annotations

import json
from collections import Counter
from pathlib import Path

import pytest

from autograder.audit.classroom import GRADED, SUBMITTED, CannotRehearse, make_class, surprises
from autograder.audit.known_essay import known_essays
from autograder.audit.known_submission import known_submission
from autograder.batch.collection import collect
from autograder.batch.records import GRADES, write_grades
from autograder.engine.essay import left_to_a_person, load_essay
from autograder.engine.exercise import load_exercise
from autograder.engine.verdict import CheckVerdict, Grade

EXERCISES = ("battery_service", "interfaces")
ESSAY = "arm_architecture"


def as_known(student: str, exercise: str, name: str) -> Grade:
    """Return the grade that a known submission must have."""
    known = known_submission(exercise, name)
    verdicts = [
        CheckVerdict(
            check.id, check.title, "failed" if check.id in known.caught_by else "passed", 0, check.points
        )
        for check in load_exercise(exercise, hidden=True).checks
    ]
    return Grade(exercise, student, "test", verdicts)


def graded(folder: Path, labels: dict[str, dict[str, str]]) -> list[Grade]:
    grades = [as_known(student, *work) for student, works in labels.items() for work in works.items()]
    write_grades(folder / GRADED / GRADES, grades)
    return grades


def test_a_class_hands_in_what_its_labels_say(tmp_path):
    labels = make_class(tmp_path, EXERCISES, 12, seed=4)
    collection = collect(tmp_path / SUBMITTED)
    assert (len(collection.works), collection.ignored, collection.refused) == (24, [], [])
    for work in collection.works:
        known = known_submission(work.exercise, labels[work.student][work.exercise])
        assert work.read().sources == known.read().sources


def test_a_seed_makes_the_same_class_again_and_another_seed_another(tmp_path):
    first, again, other = (
        make_class(tmp_path / name, EXERCISES, 8, seed=seed) for name, seed in (("a", 1), ("b", 1), ("c", 2))
    )
    assert first == again != other


def test_most_are_correct_some_faulty_and_a_few_hostile(tmp_path):
    labels = make_class(tmp_path, EXERCISES, 100)
    kinds = Counter(name.partition("/")[0] for works in labels.values() for name in works.values())
    assert kinds["correct"] > kinds["faulty"] > kinds["hostile"] > 0


def test_grades_as_known_are_no_surprise(tmp_path):
    graded(tmp_path, make_class(tmp_path, EXERCISES, 6))
    assert surprises(tmp_path) == {}


def test_a_grade_that_is_not_as_known_and_one_that_is_missing_are_named(tmp_path):
    labels = make_class(tmp_path, ["battery_service"], 6, shares={"correct": 1.0})
    first, second, *others = graded(tmp_path, labels)
    wrong = [
        CheckVerdict(one.id, one.title, "failed", 0, 1, expected="an answer", observed="none")
        for one in first.checks
    ]
    write_grades(
        tmp_path / GRADED / GRADES, [Grade("battery_service", first.student, "test", wrong), *others]
    )
    found = surprises(tmp_path)
    assert [whose.split("'")[0] for whose in found] == [first.student, second.student]
    false_failure, missing = found.values()
    assert "expected an answer; observed none" in false_failure[0]
    assert missing == ["it has no grade"]


@pytest.mark.parametrize("missing", ["labels.json", "grades.json"])
def test_what_is_missing_is_said_with_what_to_do(tmp_path, missing):
    if missing == "grades.json":
        make_class(tmp_path, ["battery_service"], 1)
    with pytest.raises(CannotRehearse, match=f"{missing} is missing"):
        surprises(tmp_path)


def test_no_class_is_overwritten(tmp_path):
    make_class(tmp_path, ["battery_service"], 1)
    before = json.loads((tmp_path / "labels.json").read_text())
    with pytest.raises(CannotRehearse, match="name a new folder"):
        make_class(tmp_path, ["battery_service"], 2)
    assert json.loads((tmp_path / "labels.json").read_text()) == before


def test_essays_are_handed_in_turn_by_turn_and_waiting_for_a_person_is_no_surprise(tmp_path):
    answers = known_essays(ESSAY)
    labels = make_class(tmp_path, [ESSAY], len(answers) + 1)
    assert len(answers) > 1
    assert [works[ESSAY] for works in labels.values()] == [each.name for each in (*answers, answers[0])]
    collection = collect(tmp_path / SUBMITTED)
    assert (len(collection.works), collection.ignored, collection.refused) == (len(labels), [], [])
    waiting = [left_to_a_person(load_essay(ESSAY), student) for student in labels]
    write_grades(tmp_path / GRADED / GRADES, waiting)
    assert surprises(tmp_path) == {}


def test_an_essay_that_a_batch_has_marked_is_a_surprise(tmp_path):
    (student,) = make_class(tmp_path, [ESSAY], 1)
    marked = [CheckVerdict("graph", "The graph", "marked", 1, 2)]
    write_grades(tmp_path / GRADED / GRADES, [Grade(ESSAY, student, "by hand", marked)])
    ((words,),) = surprises(tmp_path).values()
    assert words == "expected an essay that waits for a person; it is graded, with 1 points"
