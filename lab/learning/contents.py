"""Reads the list of chapters and their exercises from chapters/README.md."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from ros_runtime.project import WORK

CHAPTERS = WORK / "chapters"
CHAPTER_ROW = re.compile(
    r"^\| (?P<title>\w+ \[.+?\])\((?P<file>\w+\.ipynb)\) \| (?P<minutes>\d+) \| (?P<exercises>.*) \|$"
)
_EXERCISE = re.compile(r"\[(?P<name>\w+)\]\(\S+\) \((?P<minutes>\d+)\)")


@dataclass(frozen=True)
class Exercise:
    """An exercise of a chapter; `minutes` is about how long it takes."""

    name: str
    minutes: int

    @property
    def notebook(self) -> Path:
        """The notebook in which students work on it."""
        return WORK / "exercises" / self.name / f"{self.name}.ipynb"


@dataclass(frozen=True)
class Chapter:
    """A chapter, such as "1 The robot and its graph"; `minutes` is about how long it takes."""

    title: str
    notebook: Path
    minutes: int
    exercises: tuple[Exercise, ...]

    @property
    def number(self) -> str:
        """What its title begins with, such as "3a"."""
        return self.title.split()[0]

    @property
    def name(self) -> str:
        """The name of the chapter's file in chapters/support/questions, and of its module in chapters/support/gaps."""
        return self.notebook.stem.partition("_")[2]


def read_contents(chapters: Path = CHAPTERS) -> list[Chapter]:
    """Return the chapters in the order of the table in README.md of their folder."""
    rows = map(CHAPTER_ROW.match, (chapters / "README.md").read_text(encoding="utf-8").splitlines())
    return [
        Chapter(
            title=re.sub(r"[\[\]]", "", row["title"]),
            notebook=chapters / row["file"],
            minutes=int(row["minutes"]),
            exercises=tuple(
                Exercise(found["name"], int(found["minutes"]))
                for found in _EXERCISE.finditer(row["exercises"])
            ),
        )
        for row in rows
        if row
    ]
