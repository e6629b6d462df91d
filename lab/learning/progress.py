"""The student's progress so far, by chapter and exercise."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path

from lab.learning.contents import CHAPTERS, Chapter, Exercise, read_contents
from lab.learning.gap import read_gaps
from lab.learning.progress_file import kept
from lab.learning.question import Question
from ros_runtime.self_checks import LastCheck, last_checks


@dataclass(frozen=True)
class Part:
    """`done` of `of` items, with an optional suffix `also`."""

    done: int
    of: int
    also: str = ""

    def __str__(self) -> str:
        return f"{self.done}/{self.of}{self.also}" if self.of else "–"


@dataclass(frozen=True)
class ChapterProgress:
    """Progress in one chapter; an exercise that was never checked has None."""

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
        return all(part.done >= part.of for part in self.parts.values())


def read_progress() -> list[ChapterProgress]:
    """Read the progress stored beside chapters and exercises; one entry per chapter."""
    checks = last_checks()
    return [_of_chapter(chapter, checks) for chapter in read_contents()]


def next_step(chapters: Sequence[ChapterProgress]) -> tuple[str, Path]:
    """Return the next step: a sentence that lacks its last word, the name of the notebook, and that notebook."""
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
    questions = import_module(f"chapters.support.questions.{chapter.name}")
    predicted = _choices(kept("predictions", CHAPTERS), questions.PREDICTIONS)
    answered = _choices(kept("questions", CHAPTERS), questions.QUESTIONS)
    gaps = read_gaps(chapter.name)
    filled = kept("gaps", CHAPTERS)
    return ChapterProgress(
        chapter,
        parts={
            "Predictions": Part(len(predicted), len(questions.PREDICTIONS)),
            "Quiz": Part(
                len(answered), len(questions.QUESTIONS), f", {sum(answered)} right" if answered else ""
            ),
            "Gaps": Part(sum(gap.file in filled for gap in gaps), len(gaps)),
        },
        exercises=[(exercise, checks.get(exercise.name)) for exercise in chapter.exercises],
    )


def _choices(chosen: Mapping[str, str], questions: Iterable[Question]) -> list[bool]:
    """Return, for each answered question, whether the choice is right; choices whose text has changed do not count."""
    return [
        choice.right
        for question in questions
        for choice in question.choices
        if chosen.get(question.text) == choice.text
    ]
