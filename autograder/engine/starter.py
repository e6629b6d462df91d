"""The starter of an exercise: whether a program is still the one that was given out, and which places are empty."""

from __future__ import annotations

import json
import re
from functools import lru_cache
from pathlib import Path

from autograder.engine.exercise import exercises_folder
from autograder.engine.notebook import written_by
from autograder.engine.submission import Submission

_PLACES = re.compile(r"^ *# YOUR CODE HERE", re.MULTILINE)
_EMPTY_PLACES = re.compile(
    r"^(?P<indent> *)# YOUR CODE HERE.*\n(?: *(?:#.*)?\n)*(?! *(?:#|\n))(?:(?P=indent)return \w+$|(?!(?P=indent)))",
    re.MULTILINE,
)


def is_starter(submission: Submission, *notebooks: Path) -> bool:
    """Return whether a submission is the starter: as released, or as unchanged cells of a notebook write it."""
    given = [given_in(notebook.read_bytes()) for notebook in notebooks if notebook.is_file()]
    return any(same_texts(submission.sources, texts) for texts in (*given, released(submission.exercise)))


def what_is_to_be_written(submission: Submission, *notebooks: Path) -> str:
    """Return in which lines of each file nothing is written yet, and what to do, each in a line; "" if in none.

    In the starter these are all lines `# YOUR CODE HERE`, else those below which the student wrote nothing.
    """
    if not any(map(_PLACES.search, submission.sources.values())):
        return ""
    pattern = _PLACES if is_starter(submission, *notebooks) else _EMPTY_PLACES
    return "\n".join(
        f"{name} is as the starter leaves it below `# YOUR CODE HERE` in {_in_words(lines)}: write your code there."
        for name, text in submission.sources.items()
        if (lines := _lines_of(pattern, text))
    )


def _lines_of(pattern: re.Pattern[str], text: str) -> list[int]:
    return [text.count("\n", 0, place.start()) + 1 for place in pattern.finditer(text)]


def given_in(notebook: bytes) -> dict[str, str]:
    """Return the files that a notebook's untouched solution cells write, according to nbgrader's checksums."""
    from nbformat import from_dict
    from nbgrader.utils import compute_checksum, is_solution

    untouched = []
    try:
        for cell in from_dict(json.loads(notebook.decode("utf-8-sig")))["cells"]:
            cell.source = "".join(cell.source)
            if is_solution(cell) and cell.metadata.nbgrader.get("checksum") == compute_checksum(cell):
                untouched.append(cell.source)
    except Exception:  # metadata can be malformed in many ways; such a notebook does not count as untouched
        return {}
    return written_by(untouched).files


def released(exercise: str) -> dict[str, str]:
    """Return the starter files of the released notebook; empty if there is no release."""
    return _in_release(exercises_folder().parent / "exercises" / exercise / f"{exercise}.ipynb")


@lru_cache
def _in_release(notebook: Path) -> dict[str, str]:
    return given_in(notebook.read_bytes()) if notebook.is_file() else {}


def same_texts(one: object, other: object) -> bool:
    """Return whether two values are mappings with the same texts, apart from white space at their ends."""
    if not isinstance(one, dict) or not isinstance(other, dict):
        return False
    return {name: text.strip() for name, text in one.items()} == {
        name: text.strip() for name, text in other.items()
    }


def _in_words(lines: list[int]) -> str:
    *others, last = map(str, lines)
    return f"lines {', '.join(others)} and {last}" if others else f"line {last}"
