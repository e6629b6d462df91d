"""Enters grades into nbgrader's gradebook, and keeps what went wrong with it."""

from __future__ import annotations

from pathlib import Path

from autograder.classroom.batch.runner import Graded
from autograder.classroom.nbgrader_bridge.course_folder import NbgraderError
from autograder.classroom.nbgrader_bridge.gradebook import CourseGradebook, Entry
from autograder.classroom.nbgrader_bridge.rebuild_submission import NoSolutionCell
from autograder.engine.exercise import exercises_folder
from autograder.engine.verdict import Grade

LOG = "nbgrader.log"


class GradebookWriter:
    """The gradebook of an output folder; opened at the first entry."""

    def __init__(self, out: Path) -> None:
        self._out = out
        self._gradebook: CourseGradebook | None = None
        self._problems: dict[tuple[str, str], str] = {}
        self._logs: dict[tuple[str, str], str] = {}

    def enter(self, result: Graded) -> Grade:
        """Enter a grade; return it with the points that a person gave in the gradebook."""
        key = (result.work.student, result.work.exercise)
        self._problems.pop(key, None)
        self._logs.pop(key, None)
        try:
            gradebook = self._gradebook = self._gradebook or CourseGradebook(self._out, exercises_folder())
            work = result.work
            gradebook.enter(Entry(result.grade, result.sources, result.problem, work.timestamp, work.secret))
            return gradebook.as_marked(result.grade)
        except (NbgraderError, NoSolutionCell, OSError) as error:
            self._problems[key] = f"{result.work.student}'s {result.work.exercise}: {error}"
            if isinstance(error, NbgraderError):
                self._logs[key] = f"{self._problems[key]}\n{error.log}"
            return result.grade

    def problems(self) -> list[str]:
        """Return a sentence on each failed entry; nbgrader's output goes into a file."""
        found = list(self._problems.values())
        if self._logs:
            (self._out / LOG).write_text("\n\n".join(self._logs.values()))
            found.append(f"nbgrader's output is in {self._out / LOG}")
        return found
