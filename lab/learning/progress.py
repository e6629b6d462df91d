"""Reads the student's progress in each chapter and exercise, and chooses the next step."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from lab.learning.contents import CHAPTERS, Chapter, Exercise, read_contents
from lab.learning.gap import read_gaps
from lab.learning.progress_file import read_entries
from lab.learning.question import Question, read_questions
from ros_runtime.self_checks import LastCheck, last_checks


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
