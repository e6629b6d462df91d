"""The choices that a student has made, in a file beside the notebook: they outlive the kernel."""

from __future__ import annotations

import json
from pathlib import Path

from lab.question import Question

FILE = Path(".predictions.json")  # hidden, as for the files of any tool


def kept_letter(question: Question) -> str | None:
    """Return the letter chosen earlier, or None; a choice whose words have changed since does not count."""
    text = _read().get(question.text)
    return next((letter for letter, choice in question.by_letter().items() if choice.text == text), None)


def keep_letter(question: Question, letter: str | None) -> None:
    """Write down the choice made for a question, or forget it when there is none."""
    kept = _read()
    kept.pop(question.text, None)
    if letter is not None:
        kept[question.text] = question.choice(letter).text
    FILE.write_text(json.dumps(kept, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


def _read() -> dict[str, str]:
    """The text of the chosen answer under the text of its question, so that reordering either does no harm."""
    try:
        kept = json.loads(FILE.read_text(encoding="utf-8"))
    except (FileNotFoundError, ValueError):  # a damaged file only means that each question is asked again
        return {}
    return kept if isinstance(kept, dict) else {}
