"""The chapters and exercises that a class may have by now."""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from pathlib import Path

from autograder.engine.exercise import all_names
from lab.learning.contents import CHAPTER_ROW, Chapter, read_contents
from ros_runtime.course_error import CourseError

_NUMBER = re.compile(r"0*(\w+?)(_.*)?(\.ipynb)?")  # of "7", "07" and "07_cancel_and_preempt.ipynb"
_LINK = re.compile(r"\[(\w+)\]\(\.\./exercises/\S+\)")


@dataclass(frozen=True)
class Part:
    """Some of the course's chapters (None: all) and exercises.

    Attributes:
        chapters: the names of their notebooks, without .ipynb.
        exercises: the names of the exercises.
    """

    chapters: Collection[str] | None
    exercises: Collection[str]

    def has(self, path: Path) -> bool:
        """Return whether a file belongs to it: a notebook of a chapter or exercise, or a file of neither."""
        if path.suffix != ".ipynb":
            return True
        if path.parent.name == "chapters":
            return self.chapters is None or path.stem in self.chapters
        return path.parent.parent.name != "exercises" or path.stem in self.exercises

    def contents(self, readme: Path) -> str:
        """Return the page that lists chapters and exercises, without those that are left out."""
        lines = readme.read_text(encoding="utf-8").splitlines()
        return "".join(f"{self._row(line)}\n" for line in lines if self._is_listed(line))

    def _is_listed(self, line: str) -> bool:
        row = CHAPTER_ROW.match(line)
        return not row or self.chapters is None or Path(row["file"]).stem in self.chapters

    def _row(self, line: str) -> str:
        return _LINK.sub(lambda link: link[0] if link[1] in self.exercises else f"{link[1]}, not yet", line)


def part_of(chapters_folder: Path, wanted: Sequence[str], until: str = "") -> Part:
    """Return the chapters up to `until` ("": all), and the wanted exercises (none: those of the chapters).

    Raises:
        CourseError: there is no such chapter or exercise.
    """
    chapters = read_contents(chapters_folder)
    released = _up_to(chapters, until) if until else chapters
    names = [name for word in wanted for name in word.split(",") if name]
    if unknown := [name for name in names if name not in all_names()]:
        raise CourseError(f"there is no exercise {unknown[0]!r}; there are: {', '.join(all_names())}")
    if not names:
        of_chapters = [each.name for chapter in released for each in chapter.exercises]
        names = [name for name in all_names() if name in of_chapters or not until]
    return Part([chapter.notebook.stem for chapter in released] if until else None, names)


def _up_to(chapters: Sequence[Chapter], until: str) -> Sequence[Chapter]:
    found = [
        chapter for chapter in chapters if _number(until) in (_number(chapter.notebook.stem), chapter.number)
    ]
    if not found:
        numbers = ", ".join(chapter.number for chapter in chapters)
        raise CourseError(f"there is no chapter {until!r}; there are: {numbers}")
    return chapters[: chapters.index(found[-1]) + 1]


def _number(chapter: str) -> str:
    matched = _NUMBER.fullmatch(chapter)
    return matched[1] if matched else chapter
