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

HEADS = ("Chapter and its exercises", "Minutes", "Predictions", "Quiz", "Gaps")
LEFT = "style='text-align: left; white-space: nowrap'"
INDENTED = "style='text-align: left; white-space: nowrap; padding-left: 2em'"


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
        rows = "".join(f"<tr>{cells}</tr>" for row in self.chapters for cells in _rows(row))
        return (
            f"<p><b>{sentence} {_link(notebook, titles.get(notebook, notebook.stem))}.</b></p>"
            f"<table><thead><tr>{heads}</tr></thead><tbody>{rows}</tbody></table>"
        )


def _rows(row: ChapterProgress) -> Iterator[str]:
    """Return the cells of a chapter, then those of each of its exercises: all fit beside the robot's panel."""
    parts = "".join(f"<td {LEFT}>{_bar(part, name)}</td>" for name, part in row.parts.items())
    yield f"<td {LEFT}>{_link(row.chapter.notebook, row.chapter.title)}</td><td>{row.chapter.minutes}</td>{parts}"
    for exercise, check in row.exercises:
        name = f"<td {INDENTED}>{_link(exercise.notebook, exercise.name)}</td><td>{exercise.minutes}</td>"
        yield f"{name}<td {LEFT} colspan='{len(row.parts)}'>{_checked(exercise, check)}</td>"


def _bar(part: Part, what: str) -> str:
    if not part.total:
        return str(part)
    label = f"{what}: {part.done} of {part.total}"
    bar = f'<progress value="{part.done}" max="{part.total}" aria-label="{label}" style="width: 2em"></progress>'
    return f"{bar} {part}"


def _checked(exercise: Exercise, check: LastCheck | None) -> str:
    if check is None:
        return _in_words(check)
    return f"{_bar(Part(check.passed, check.total), exercise.name)} checks, {_when(check)}"


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
