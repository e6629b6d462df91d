"""Predictions: made before a cell is run, kept, and answered after it."""

from __future__ import annotations

from pathlib import Path

import ipywidgets
import pytest

import lab
from lab.learning.prediction import Prediction
from lab.learning.progress_file import NAME
from lab.learning.question import Choice, Question, read_questions
from ros_runtime.project import COURSE

ALL = [
    (chapter, number)
    for chapter in sorted(path.stem for path in (COURSE / "chapters/support/questions").glob("*.yaml"))
    for number in range(1, len(read_questions(chapter, "predictions")) + 1)
]
EXAMPLE = Question(
    "What is 2 + 2?",
    (Choice("5", "A sensible guess: it's close. But count."), Choice("4", "Count.", right=True)),
)


@pytest.fixture(autouse=True)
def in_a_folder_of_its_own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def panel(prediction: Prediction) -> tuple[ipywidgets.RadioButtons, ipywidgets.Button, ipywidgets.HTML]:
    """The widgets below the question: the answers, the button "Clear", and a note."""
    answers, row = prediction._panel().children
    note, clear = row.children
    return answers, clear, note


def test_an_experiment_waits_for_a_prediction() -> None:
    prediction = Prediction(3, EXAMPLE)
    wish = r'Predict first: click a or b under Prediction 3, or run prediction_3\.choose\("a"\) in a cell'
    with pytest.raises(lab.LabError, match=wish):
        prediction.require()
    prediction.choose("a")
    prediction.require()


def test_a_prediction_can_also_be_made_with_the_word_of_the_quiz() -> None:
    prediction = Prediction(1, EXAMPLE)
    prediction.answer("b")
    assert prediction.letter == "b"


def test_a_click_makes_the_prediction_and_says_what_to_do_next() -> None:
    prediction = Prediction(1, EXAMPLE)
    answers, _, note = panel(prediction)
    assert "Choose a or b." in note.value
    answers.value = "b"
    assert "You predict b. Run the next cell." in note.value
    prediction.require()


def test_the_answers_themselves_are_clicked_and_shown_where_there_are_no_widgets(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    answers, _, _ = panel(Prediction(1, EXAMPLE))
    assert answers.options == (("a) 5", "a"), ("b) 4", "b"))
    shown: list[dict] = []
    monkeypatch.setattr("lab.learning.question.display", lambda bundle, raw: shown.append(bundle))
    EXAMPLE.show(answers, 'prediction_1.choose("a")')
    assert "application/vnd.jupyter.widget-view+json" in shown[0]
    assert "<b>b)</b> 4" in shown[0]["text/html"]
    assert "prediction_1.choose" in shown[0]["text/html"]


def test_a_choice_is_kept_when_the_cell_or_the_kernel_starts_again() -> None:
    Prediction(1, EXAMPLE).choose("b")
    again = Prediction(1, EXAMPLE)
    assert again.letter == "b"
    assert "You predict b. Run the next cell." in panel(again)[2].value


def test_a_choice_can_be_cleared_for_good() -> None:
    prediction = Prediction(1, EXAMPLE)
    prediction.choose("b")
    _, clear, note = panel(prediction)
    clear.click()
    assert "Choose a or b." in note.value
    assert Prediction(1, EXAMPLE).letter is None


def test_predictions_are_kept_side_by_side() -> None:
    other = Question("What is 2 + 3?", EXAMPLE.choices)
    Prediction(1, EXAMPLE).choose("b")
    Prediction(2, other).choose("a")
    assert (Prediction(1, EXAMPLE).letter, Prediction(2, other).letter) == ("b", "a")


def test_a_stored_choice_follows_its_words_not_its_letter() -> None:
    Prediction(1, EXAMPLE).choose("b")
    assert Prediction(1, Question(EXAMPLE.text, EXAMPLE.choices[::-1])).letter == "a"
    reworded = Question(EXAMPLE.text, (EXAMPLE.choices[0], Choice("four", "Count.", right=True)))
    assert Prediction(1, reworded).letter is None


@pytest.mark.parametrize("damaged", ["", "{", "[]", '{"predictions": []}'])
def test_with_a_damaged_file_the_prediction_is_requested_again(damaged: str) -> None:
    Path(NAME).write_text(damaged)
    prediction = Prediction(1, EXAMPLE)
    assert prediction.letter is None
    prediction.choose("b")
    assert Prediction(1, EXAMPLE).letter == "b"


def test_the_reply_depends_on_the_choice(capsys: pytest.CaptureFixture[str]) -> None:
    prediction = Prediction(1, EXAMPLE)
    prediction.choose("a")
    prediction.reply()
    prediction.choose("b")
    prediction.reply()
    assert capsys.readouterr().out == (
        "You predicted a: 5\nIt went differently. A sensible guess: it's close. But count.\n"
        "You predicted b: 4\nRight. Count.\n"
    )


def test_the_reply_waits_for_an_experiment_that_had_no_choice(capsys: pytest.CaptureFixture[str]) -> None:
    prediction = Prediction(1, EXAMPLE)
    with pytest.raises(lab.LabError, match="Predict first"):
        prediction.require()
    prediction.choose("b")
    prediction.reply()
    prediction.require()
    prediction.reply()
    first, second, *_ = capsys.readouterr().out.splitlines()
    assert first.startswith("Predict first, then run the experiment: its cell has not run")
    assert second == "You predicted b: 4"


def test_without_a_choice_the_reply_asks_for_one(capsys: pytest.CaptureFixture[str]) -> None:
    Prediction(1, EXAMPLE).reply()
    assert capsys.readouterr().out.startswith("Predict first: click a or b under Prediction 1")


def test_an_unknown_letter_names_the_choices_and_changes_nothing() -> None:
    prediction = Prediction(1, EXAMPLE)
    prediction.choose("a")
    with pytest.raises(lab.LabError, match="'c' is not a choice; the choices are a, b"):
        prediction.choose("c")
    assert prediction.letter == "a"


def test_a_missing_prediction_is_reported() -> None:
    with pytest.raises(lab.LabError, match="no question 99"):
        lab.predict(ALL[0][0], 99)


@pytest.mark.parametrize(("chapter", "number"), ALL)
def test_the_reply_to_each_wrong_choice_says_why_it_is_plausible_and_wrong(chapter: str, number: int) -> None:
    choices = lab.predict(chapter, number).question.choices
    assert len(choices) >= 3
    assert len({choice.why for choice in choices}) == len(choices)
    for choice in choices:
        assert len(choice.why) > 40
        assert choice.right or choice.why.startswith("A sensible guess: ")
        assert choice.right or ". But " in choice.why
