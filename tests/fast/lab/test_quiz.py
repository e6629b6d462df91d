"""The chapters' questions and how they are marked."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import pytest

import lab
from lab.learning.question import Choice, Question, as_status, read_questions
from lab.learning.quiz import Quiz
from ros_runtime.project import COURSE

CHAPTERS = sorted(path.stem for path in (COURSE / "chapters/support/questions").glob("*.yaml"))
ALL = [
    (chapter, number)
    for chapter in CHAPTERS
    for number in range(1, len(read_questions(chapter, "questions")) + 1)
]
EXAMPLE = Question("2 + 2?", (Choice("4", "Count.", right=True), Choice("5", "One too many.")))


@pytest.fixture(autouse=True)
def in_a_folder_of_its_own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def test_the_right_choice_is_confirmed_with_a_reason() -> None:
    assert Quiz("Question 1", EXAMPLE).mark("a") == "a: Right. Count."


def test_a_wrong_choice_is_rejected_with_a_reason() -> None:
    assert Quiz("Question 1", EXAMPLE).mark("b") == "b: Not this one. One too many."


def test_an_unknown_letter_names_the_choices() -> None:
    with pytest.raises(lab.LabError, match="'c' is not a choice; the choices are a, b"):
        Quiz("Question 1", EXAMPLE).mark("c")


def test_clicking_an_answer_shows_the_verdict() -> None:
    buttons, verdict = Quiz("Question 1", EXAMPLE)._buttons().children
    buttons.value = "b"
    assert verdict.value == as_status("b: Not this one. One too many.")


def test_an_answer_is_kept_whether_written_or_clicked() -> None:
    Quiz("Question 1", EXAMPLE).answer("b")
    buttons, verdict = Quiz("Question 1", EXAMPLE)._buttons().children
    assert (buttons.value, verdict.value) == ("b", as_status("b: Not this one. One too many."))
    buttons.value = "a"
    assert Quiz("Question 1", EXAMPLE)._buttons().children[0].value == "a"


def test_a_question_can_also_be_answered_with_the_word_of_predictions(
    capsys: pytest.CaptureFixture[str],
) -> None:
    Quiz("Question 1", EXAMPLE).choose("a")
    assert capsys.readouterr().out == "a: Right. Count.\n"


def test_code_in_a_question_is_shown_as_code() -> None:
    question = Question("What does `a < b` do?", EXAMPLE.choices)
    assert "<code>a &lt; b</code>" in question.text_under("Question 1").data


def test_a_question_has_one_right_choice() -> None:
    with pytest.raises(ValueError, match="exactly one right choice"):
        Question("?", (Choice("a", "why"), Choice("b", "why")))


def test_a_missing_question_is_reported() -> None:
    with pytest.raises(lab.LabError, match="no question 99"):
        lab.quiz(CHAPTERS[0], 99)


def test_the_order_of_the_choices_differs_between_students(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    first: Counter[int] = Counter()
    for student in range(40):
        (tmp_path / str(student)).mkdir()
        monkeypatch.chdir(tmp_path / str(student))
        texts = [[choice.text for choice in lab.quiz(*ALL[0]).question.choices] for _ in range(2)]
        assert texts[0] == texts[1]
        first[next(i for i, choice in enumerate(lab.quiz(*ALL[0]).question.choices) if choice.right)] += 1
    assert len(first) == len(lab.quiz(*ALL[0]).question.choices)  # the right one stands anywhere


@pytest.mark.parametrize(("chapter", "number"), ALL)
def test_every_choice_of_every_question_is_marked_with_its_own_reason(chapter: str, number: int) -> None:
    quiz = lab.quiz(chapter, number)
    verdicts = [quiz.mark(letter) for letter in "abcdefgh"[: len(quiz.question.choices)]]
    assert len(verdicts) >= 3
    assert len(set(verdicts)) == len(verdicts)
    assert all(len(choice.why) >= 30 for choice in quiz.question.choices)
