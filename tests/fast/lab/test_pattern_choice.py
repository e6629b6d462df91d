"""The choice of topic, service or action by the first question that is answered with yes."""

from __future__ import annotations

import pytest

import lab


@pytest.mark.parametrize(
    ("words", "pattern"),
    [
        (["yes"], "action"),
        (["no", "yes"], "action"),
        (["no", "no", "yes"], "action"),
        (["no", "no", "no", "yes"], "service"),
        (["no", "no", "no", "no"], "topic"),
    ],
)
def test_the_first_yes_decides_with_a_reason(
    words: list[str], pattern: str, capsys: pytest.CaptureFixture[str]
) -> None:
    choice = lab.choose_pattern()
    for word in words:
        assert choice.pattern is None
        choice.answer(word)
    assert choice.pattern == pattern
    last = capsys.readouterr().out.splitlines()[-1]
    assert last.startswith(f"{pattern.capitalize()}: ")
    assert len(last) > 60


def test_the_questions_are_asked_in_order(capsys: pytest.CaptureFixture[str]) -> None:
    choice = lab.choose_pattern()
    asked = [choice.text()]
    for _ in range(3):
        choice.answer("no")
        asked.append(choice.text())
    assert [text.split(":")[0] for text in asked] == [
        "Question 1. Cancel",
        "Question 2. Progress",
        "Question 3. Duration",
        "Question 4. Answer",
    ]
    assert capsys.readouterr().out.splitlines() == asked[1:]


def test_the_buttons_do_the_same_and_keep_the_focus_after_the_decision() -> None:
    choice = lab.choose_pattern()
    note, row = choice._panel().children
    yes, no, restart = row.children
    no.click()
    assert "Question 2." in note.value
    yes.click()
    assert "Action: " in note.value
    no.click()
    assert "Action: " in note.value
    assert (yes.disabled, no.disabled) == (False, False)  # a disabled button loses the focus
    restart.click()
    assert "Question 1." in note.value


def test_other_words_and_further_answers_are_refused() -> None:
    choice = lab.choose_pattern()
    with pytest.raises(lab.LabError, match="'maybe' is not accepted"):
        choice.answer("maybe")
    choice.answer("yes")
    with pytest.raises(lab.LabError, match=r"the pattern is already decided: action; call restart\(\)"):
        choice.answer("no")
    choice.restart()
    assert choice.pattern is None
