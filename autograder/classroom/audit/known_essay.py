"""Answers to an essay, as a class hands them in: whatever they say, they wait for a person."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from autograder.engine.exercise import exercises_folder, file_names
from autograder.engine.submission import Submission
from autograder.engine.verdict import Grade

MARKED = "marked"  # the folder of answers that instructors compare with, in an essay's


@dataclass(frozen=True)
class KnownEssay:
    """An answer in a file: the notebook with the solution, or a text."""

    exercise: str
    path: Path

    @property
    def name(self) -> str:
        """Its name in labels, such as essay/weak.txt."""
        return f"essay/{self.path.name}"

    def read(self) -> Submission:
        """Return what is handed in: a notebook as it is, or the text in the file that students write."""
        name = self.path.name if self.path.suffix == ".ipynb" else file_names(self.exercise)[0]
        return Submission(self.exercise, self.name, {name: self.path.read_text(encoding="utf-8")})


def known_essays(exercise: str) -> list[KnownEssay]:
    """Return the answers there are: the solution's notebook, and those that are marked for comparison."""
    folder = exercises_folder() / exercise
    paths = [folder / f"{exercise}.ipynb", *sorted((folder / MARKED).glob("*.txt"))]
    return [KnownEssay(exercise, path) for path in paths if path.is_file()]


def surprises_in_essay(grade: Grade) -> list[str]:
    """Describe what a batch did with an essay other than to leave it to a person; empty if nothing."""
    if grade.status == "to mark" and not any(check.points for check in grade.checks):
        return []
    return [f"expected an essay that waits for a person; it is {grade.status}, with {grade.score} points"]
