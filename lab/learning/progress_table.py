"""The progress table on the lab's start page."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from datetime import datetime
from html import escape
from pathlib import Path

from lab.learning.contents import Exercise
from lab.learning.progress import ChapterProgress, Part, next_step, read_progress
from ros_runtime.self_checks import LastCheck

HEADS = ("Chapter", "Minutes", "Predictions", "Quiz", "Gaps", "Exercises: minutes, checks passed")
LEFT = "style='text-align: left'"
ONE_LINE = "style='text-align: left; white-space: nowrap'"


def show_progress() -> ProgressTable:
    """Return a table of the student's progress, with the last self-check of each exercise and the next step."""
    return ProgressTable(read_progress())


class ProgressTable:
    """The progress as a table in a notebook, and as lines of text elsewhere."""

    def __init__(self, chapters: Sequence[ChapterProgress]) -> None:
        self.chapters = chapters

    def __repr__(self) -> str:
        sentence, notebook = next_step(self.chapters)
        lines = [f"{sentence} {_relative(notebook)}"]
        for row in self.chapters:
            parts = ", ".join(f"{name.lower()} {part}" for name, part in row.parts.items())
            lines.append(f"{row.chapter.title}: {parts}")
            lines += [f"    {exercise.name}: {_in_words(check)}" for exercise, check in row.exercises]
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        sentence, notebook = next_step(self.chapters)
        titles = {row.chapter.notebook: row.chapter.title for row in self.chapters}
        heads = "".join(f"<th {LEFT}>{head}</th>" for head in HEADS)
        rows = "".join(f"<tr>{''.join(_cells(row))}</tr>" for row in self.chapters)
        return (
            f"<p><b>{sentence} {_link(notebook, titles.get(notebook, notebook.stem))}.</b></p>"
            f"<table><thead><tr>{heads}</tr></thead><tbody>{rows}</tbody></table>"
        )


def _cells(row: ChapterProgress) -> Iterator[str]:
    yield f"<td {LEFT}>{_link(row.chapter.notebook, row.chapter.title)}</td>"
    yield f"<td>{row.chapter.minutes}</td>"
    for name, part in row.parts.items():
        yield f"<td {ONE_LINE}>{_bar(part, name)}</td>"
    yield f"<td {LEFT}>{'<br>'.join(_exercise(exercise, check) for exercise, check in row.exercises)}</td>"


def _bar(part: Part, what: str) -> str:
    if not part.total:
        return str(part)
    label = f"{what}: {part.done} of {part.total}"
    bar = f'<progress value="{part.done}" max="{part.total}" aria-label="{label}" style="width: 3em"></progress>'
    return f"{bar} {part}"


def _exercise(exercise: Exercise, check: LastCheck | None) -> str:
    link = f"{_link(exercise.notebook, exercise.name)} ({exercise.minutes})"
    if check is None:
        return f"{link}: {_in_words(check)}"
    return f"{link}: {_bar(Part(check.passed, check.total), exercise.name)}, {_when(check)}"


def _in_words(check: LastCheck | None) -> str:
    return f"{check.passed}/{check.total} checks passed, {_when(check)}" if check else "not checked yet"


def _when(check: LastCheck) -> str:
    try:
        return f"{datetime.fromisoformat(check.at):%d %b %H:%M}"
    except ValueError:
        return check.at


def _link(notebook: Path, words: str) -> str:
    return f'<a href="{_relative(notebook)}">{escape(words)}</a>'


def _relative(path: Path) -> str:
    """Return the path relative to the notebook's folder, because Jupyter's links need a relative path."""
    return Path(os.path.relpath(path)).as_posix()
