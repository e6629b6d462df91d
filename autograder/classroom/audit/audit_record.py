"""The file of `course audit --json`: rewritten after every run, so that an interrupted audit can be resumed."""

from __future__ import annotations

import json
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from autograder.atomic_file import write_atomically
from autograder.classroom.audit.known_submission import KnownSubmission
from autograder.classroom.audit.run import AuditedRun, for_any_fault
from autograder.classroom.batch.cache import grade_key
from autograder.engine.exercise import Exercise
from autograder.engine.verdict import Grade
from autograder.isolation.availability import Isolation
from ros_runtime.course_error import CourseError

_Place = tuple[str, str, int | None]  # exercise, submission and seed, which identify a run


class AuditRecord:
    """The runs of an audit by exercise, one per line; earlier runs stay until their submissions are graded again.

    An earlier run is reused if everything that its verdict depends on is unchanged: submission, checks, engine, robot,
    seed, clock scale and isolation. A run is not reused if the grader failed, or if the submission was edited while it
    was graded.
    """

    def __init__(
        self,
        path: Path | None,
        *,
        isolation: Isolation,
        scale: float | None = None,
        earlier: Iterable[dict[str, Any]] = (),
    ) -> None:
        """`path`: the file to write, or None. `scale`: the clock scale. `earlier`: the runs from `read_runs`."""
        self.scale = scale
        self._path = path
        self._isolation = isolation
        self._runs = {_place(run): json.dumps(run) for run in earlier}
        self._keys: dict[_Place, str] = {}  # hash of each submission, taken before it is graded

    def earlier_run(
        self, known: KnownSubmission, exercise: Exercise, repetition: int, seed: int
    ) -> AuditedRun | None:
        """Return the earlier run with this seed, numbered as this repetition; None if no run can be reused.

        Call this before grading: it stores the submission's hash, so that `add` can detect later edits.
        """
        place = known.exercise, known.name, seed
        key = self._keys[place] = self._key(known, exercise, seed)
        earlier = json.loads(self._runs.get(place, "{}"))
        if earlier.get("key") != key:
            return None
        grade = Grade.from_json(earlier["grade"])
        run = AuditedRun(known, repetition, grade, earlier["seconds"], for_any_fault(exercise))
        if run.grade.status != "graded":
            return None
        self._put(run, exercise)  # the submission's header may have changed
        return run

    def add(self, run: AuditedRun, exercise: Exercise) -> None:
        """Add a run, in place of an earlier run of the same submission and seed, and write the file."""
        self._put(run, exercise)
        self.write()

    def write(self) -> None:
        """Write the file, unless `path` is None."""
        if self._path:
            write_atomically(self._path, self._text())

    def _put(self, run: AuditedRun, exercise: Exercise) -> None:
        entry = run.to_json()
        place = _place(entry)
        known_key = self._keys.get(place)
        if known_key and known_key == self._key(run.known, exercise, entry["grade"]["seed"]):
            entry["key"] = known_key
        self._runs[place] = json.dumps(entry)

    def _key(self, known: KnownSubmission, exercise: Exercise, seed: int) -> str:
        return grade_key(known.read(), exercise, seed, self._isolation, self.scale)

    def _text(self) -> str:
        by_exercise: dict[str, list[str]] = {}
        for (exercise, _, _), line in self._runs.items():
            by_exercise.setdefault(exercise, []).append(line)
        lists = [f"{json.dumps(name)}: [\n{_joined(lines)}\n]" for name, lines in by_exercise.items()]
        return f"{{\n{_joined(lists)}\n}}\n"


def read_runs(path: Path) -> list[dict[str, Any]]:
    """Return the runs in the file of an earlier audit; an empty list if the file does not exist.

    Raises:
        CourseError: `course audit --json` did not write this file.
    """
    if not path.exists():
        return []
    try:
        runs = [run for of_one in json.loads(path.read_text(encoding="utf-8")).values() for run in of_one]
        for run in runs:
            Grade.from_json(run["grade"])
            _place(run), float(run["seconds"])
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise CourseError(
            f"{path} was not written by course audit --json ({type(error).__name__}: {error}); name another file, "
            "or leave out --resume to overwrite it"
        ) from error
    return runs


def _place(run: dict[str, Any]) -> _Place:
    return run["grade"]["exercise"], run["submission"], run["grade"]["seed"]


def _joined(lines: Iterable[str]) -> str:
    return ",\n".join(lines)
