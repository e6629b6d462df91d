"""The progress table on the lab's start page."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime
from functools import partial
from html import escape
from pathlib import Path

from lab.learning.contents import CHAPTERS, Chapter, Exercise, read_contents
from lab.learning.gap import read_gaps
from lab.learning.progress_file import read_entries
from lab.learning.question import Question, read_questions
from ros_runtime.self_checks import LastCheck, last_checks, submitted_folders

HEADS = ("Chapter and its exercises", "Min.", "Predictions", "Quiz", "Gaps")
LEFT = "style='text-align: left; white-space: nowrap'"
NAME = "style='text-align: left'"  # long names wrap where the page is narrow
INDENTED = "style='text-align: left; padding-left: 2em'"


@dataclass(frozen=True)
class Part:
    """How many items of one kind are done, of how many; `suffix` is appended when it is printed."""

    done: int
    total: int
    suffix: str = ""

    def __str__(self) -> str:
        return f"{self.done}/{self.total}{self.suffix}" if self.total else "–"


@dataclass(frozen=True)
class ChapterProgress:
    """Progress in one chapter; `exercises` has None for an exercise that was never checked."""

    chapter: Chapter
    parts: Mapping[str, Part]
    exercises: Sequence[tuple[Exercise, LastCheck | None]]

    @property
    def begun(self) -> bool:
        """Whether any part of the chapter is done."""
        return any(part.done for part in self.parts.values()) or any(check for _, check in self.exercises)

    @property
    def read(self) -> bool:
        """Whether everything except the exercises is done."""
        return all(part.done >= part.total for part in self.parts.values())


def read_progress() -> list[ChapterProgress]:
    """Return the progress in each chapter, as it is stored beside the chapters and the exercises."""
    checks = last_checks()
    return [_of_chapter(chapter, checks) for chapter in read_contents()]


def next_step(chapters: Sequence[ChapterProgress]) -> tuple[str, Path]:
    """Return the next step: a notebook, and a sentence to which the caller appends that notebook's name."""
    if not any(chapter.begun for chapter in chapters):
        first = chapters[0].chapter
        return (
            "Nothing done yet. Your first step, with a robot that walks in five minutes: open",
            first.notebook,
        )
    for row in chapters:
        if not row.read:
            return "Go on with", row.chapter.notebook
        for exercise, check in row.exercises:
            if check is None or check.passed < check.total:
                return "Now do the exercise", exercise.notebook
    return "All done. Have another look at", chapters[-1].chapter.notebook


def _of_chapter(chapter: Chapter, checks: Mapping[str, LastCheck]) -> ChapterProgress:
    predictions = read_questions(chapter.name, "predictions")
    questions = read_questions(chapter.name, "questions")
    predicted = _choices(read_entries("predictions", CHAPTERS), predictions)
    answered = _choices(read_entries("questions", CHAPTERS), questions)
    gaps = read_gaps(chapter.name)
    filled = read_entries("gaps", CHAPTERS)
    return ChapterProgress(
        chapter,
        parts={
            "Predictions": Part(len(predicted), len(predictions)),
            "Quiz": Part(len(answered), len(questions), f", {sum(answered)} right" if answered else ""),
            "Gaps": Part(sum(gap.file in filled for gap in gaps), len(gaps)),
        },
        exercises=[(exercise, checks.get(exercise.name)) for exercise in chapter.exercises],
    )


def _choices(chosen: Mapping[str, str], questions: Iterable[Question]) -> list[bool]:
    """Return for each answered question whether the choice is right; a choice whose text has changed is left out."""
    return [
        choice.right
        for question in questions
        for choice in question.choices
        if chosen.get(question.text) == choice.text
    ]


def show_progress() -> ProgressTable:
    """Return a table of the student's progress, with the last self-check of each exercise and the next step."""
    return ProgressTable(read_progress())


class ProgressTable:
    """The progress as a table in a notebook, and as lines of text elsewhere."""

    def __init__(self, chapters: Sequence[ChapterProgress]) -> None:
        self.chapters = chapters
        self._as_of = f"This is how far you were on {datetime.now():%Y-%m-%d at %H:%M}."

    def __repr__(self) -> str:
        sentence, notebook = next_step(self.chapters)
        lines = [f"{sentence} {_relative(notebook)}", self._as_of]
        folders = submitted_folders()
        for row in self.chapters:
            parts = ", ".join(f"{name.lower()} {part}" for name, part in row.parts.items())
            lines.append(f"{row.chapter.title}: {parts}")
            lines += [
                f"    {exercise.name}: {_in_words(check, folders.get(exercise.name))}"
                for exercise, check in row.exercises
            ]
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        sentence, notebook = next_step(self.chapters)
        titles = {row.chapter.notebook: row.chapter.title for row in self.chapters}
        heads = "".join(f"<th {LEFT}>{head}</th>" for head in HEADS)
        folders = submitted_folders()
        rows = "".join(f"<tr>{cells}</tr>" for row in self.chapters for cells in _rows(row, folders))
        return (
            f"<p><b>{sentence} {_link(notebook, titles.get(notebook, notebook.stem))}.</b> {self._as_of}</p>"
            "<div style='overflow-x: auto' tabindex='0' role='group' aria-label='progress'>"
            f"<table><thead><tr>{heads}</tr></thead><tbody>{rows}</tbody></table></div>"
        )


def _rows(row: ChapterProgress, folders: Mapping[str, str]) -> Iterator[str]:
    """Return the cells of a chapter, then those of each of its exercises: all fit beside the robot's panel."""
    parts = "".join(f"<td {LEFT}>{_bar(part, name)}</td>" for name, part in row.parts.items())
    yield f"<td {NAME}>{_link(row.chapter.notebook, row.chapter.title)}</td><td>{row.chapter.minutes}</td>{parts}"
    for exercise, check in row.exercises:
        name = f"<td {INDENTED}>{_link(exercise.notebook, exercise.name)}</td><td>{exercise.minutes}</td>"
        done = _in_words(check, folders.get(exercise.name), partial(_bar, what=exercise.name))
        yield f"{name}<td {LEFT} colspan='{len(row.parts)}'>{done}</td>"


def _bar(part: Part, what: str) -> str:
    if not part.total:
        return str(part)
    label = f"{what}: {part.done} of {part.total}"
    bar = f'<progress value="{part.done}" max="{part.total}" aria-label="{label}" style="width: 1.5em"></progress>'
    return f"{bar} {part}"


def _in_words(check: LastCheck | None, folder: str | None, show: Callable[[Part], str] = str) -> str:
    """Return how the last self-check ended, and where the file to hand in is."""
    checked = (
        f"{show(Part(check.passed, check.total))} checks passed, {_when(check)}"
        if check
        else "not checked yet"
    )
    return f"{checked}; file in {escape(folder)}/" if folder else checked


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
