"""An exercise as the controller sees it: a folder, and its checks, visible and hidden, in order.

    FOLDER/battery_service/battery_service.ipynb   the task, with its solution
                           scenarios.py            stimuli for the student's program; runs in the arena
                           checks.py, hidden.py    the checks that judge the transcripts
                           known/                  submissions with known verdicts

An essay, which a person marks, has rubric.py instead of checks and scenarios (`autograder.engine.essay`).

checks.py and hidden.py may import further modules of the folder, as in `from .judging import …`.
"""

from __future__ import annotations

import ast
import hashlib
import importlib
import os
import re
import sys
import traceback
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING

from autograder.engine.notebook import text_of_cell
from ros_runtime.course_error import CourseError
from ros_runtime.project import PROJECT
from ros_runtime.suggestion import suggestion

if TYPE_CHECKING:
    from autograder.authoring.checks import Check

FOLDER_VARIABLE = "COURSE_EXERCISES"  # inherited by the processes that a command starts
SCENARIO_FILE, CHECKS, HIDDEN, RUBRIC = "scenarios.py", "checks", "hidden", "rubric"
_CLAUSE = re.compile(r"^(\d+)\. +(.+(?:\n(?!\d+\. |\n).+)*)", re.MULTILINE)
_MARKUP = re.compile(r"[`*]")


class UnknownExercise(CourseError):
    """There is no exercise of that name."""


class UnusableExercise(CourseError):
    """What an exercise's author wrote cannot be used; the message says where and why."""


@dataclass(frozen=True)
class Exercise:
    """The checks of one exercise; the hidden ones are absent from the students' bundle."""

    name: str
    folder: Path
    checks: Sequence[Check]

    @property
    def file_names(self) -> tuple[str, ...]:
        """The files a student writes."""
        return file_names(self.name)

    @property
    def scenario_file(self) -> Path:
        """The module with the scenarios: the only file of the exercise that an arena can read."""
        return self.folder / SCENARIO_FILE

    def max_score(self) -> int:
        """Return the points of all its checks."""
        return sum(check.points for check in self.checks)


def exercises_folder() -> Path:
    """Return the folder of exercises that this process works with.

    That is the folder given to `use_exercises_of`, else solutions/ of the clone, or checks/ of a student's copy.
    """
    if given := os.environ.get(FOLDER_VARIABLE):
        return Path(given)
    folders = [PROJECT / "solutions", PROJECT / "checks"]
    return next((folder for folder in folders if folder.is_dir()), folders[0])


def use_exercises_of(folder: Path) -> None:
    """Work with the exercises of this folder from here on, in this process and those it starts.

    Raises:
        UnusableExercise: the folder holds none.
    """
    if not _names_in(folder, CHECKS, RUBRIC):
        raise UnusableExercise(f"{folder} holds no exercise; expected {folder}/<exercise>/{CHECKS}.py")
    os.environ[FOLDER_VARIABLE] = str(folder.resolve())


def exercise_names() -> list[str]:
    """Name the exercises that checks judge."""
    return _names_in(exercises_folder(), CHECKS)


def essay_names() -> list[str]:
    """Name the exercises that a person marks."""
    essays = _names_in(exercises_folder(), RUBRIC)
    return [name for name in essays if name not in exercise_names()]


def all_names() -> list[str]:
    """Name all exercises."""
    return _names_in(exercises_folder(), CHECKS, RUBRIC)


def file_names(exercise: str) -> tuple[str, ...]:
    """Return the names of the files a student writes: one program, unless the exercise's __init__.py lists FILES.

    Raises:
        UnknownExercise: there is none of that name; the message names a similar one, or all.
    """
    return getattr(exercise_module(exercise), "FILES", (f"{exercise}.py",))


def submission_names(exercise: str) -> tuple[str, ...]:
    """Return the names under which an exercise's work is looked for: its notebook, then its files."""
    return (f"{exercise}.ipynb", *file_names(exercise))


def scenario_file(exercise: str) -> Path:
    """Return where an exercise's scenarios are, if there is such an exercise."""
    return exercises_folder() / exercise / SCENARIO_FILE


def load_exercise(name: str, *, hidden: bool) -> Exercise:
    """Load an exercise with or without its hidden checks.

    Raises:
        UnknownExercise: there is none of that name, or a person marks it.
        UnusableExercise: its author has something to fix.
    """
    # Imported late: it takes time, and a command that lists names does not need it.
    from autograder.authoring.checks import checks_in

    if name in essay_names():
        raise UnknownExercise(f"{name} has no checks: a person marks it")
    folder = exercises_folder() / name
    checks = visible = checks_in(exercise_module(name, CHECKS))
    if hidden and (folder / f"{HIDDEN}.py").exists():
        also = checks_in(exercise_module(name, HIDDEN), excluded=visible)
        checks = visible + [replace(check, hidden=True) for check in also]
    statement = clauses_in(folder / f"{name}.ipynb")
    checks = [replace(check, promise=clauses_in_words(statement, check.clauses)) for check in checks]
    exercise = Exercise(name, folder, checks)
    _require_sound_checks(exercise)
    _require_scenarios(exercise)
    return exercise


def exercise_module(exercise: str, module: str = "") -> ModuleType:
    """Import a module of an exercise's folder, or, without a name, the folder as a package.

    Raises:
        UnknownExercise: there is no such exercise.
        UnusableExercise: the module cannot be imported.
    """
    folder = exercises_folder()
    if exercise not in (known := all_names()):
        advice = suggestion(exercise, known, f"there are {', '.join(known)}")
        raise UnknownExercise(f"there is no exercise {exercise!r}; {advice}")
    try:
        return importlib.import_module(".".join(filter(None, (_package(folder), exercise, module))))
    except Exception as error:  # whatever an author's module can raise
        place = traceback.extract_tb(error.__traceback__)[-1]
        raise UnusableExercise(
            f"{folder / exercise / (module or '__init__')}.py cannot be imported: {type(error).__name__}: {error} "
            f"({place.filename}, line {place.lineno})"
        ) from error


def _names_in(folder: Path, *modules: str) -> list[str]:
    """Name the exercises that have one of these modules."""
    if not folder.is_dir():
        return []
    return sorted(
        place.name
        for place in folder.iterdir()
        if place.name.isidentifier() and any((place / f"{module}.py").exists() for module in modules)
    )


def _package(folder: Path) -> str:
    """Return the name of the package, one for each folder, under which its exercises can be imported."""
    name = f"exercises_{hashlib.sha256(str(folder.resolve()).encode()).hexdigest()[:12]}"
    if name not in sys.modules:
        package = ModuleType(name, f"The exercises in {folder}.")
        package.__path__ = [str(folder.resolve())]
        sys.modules[name] = package
    return name


def _require_sound_checks(exercise: Exercise) -> None:
    """Require that each check has an id of its own and needs only checks that come before it."""
    seen: set[str] = set()
    for check in exercise.checks:
        if not check.id:
            raise UnusableExercise(f"a check in a list of {exercise.name} has no id: “{check.title}”")
        if check.id in seen:
            raise UnusableExercise(f"two checks of {exercise.name} are called {check.id}")
        if missing := {need.id for need in check.needs} - seen:
            raise UnusableExercise(
                f"{check.id} of {exercise.name} needs {sorted(missing)}, which do not come before it"
            )
        seen.add(check.id)


def _require_scenarios(exercise: Exercise) -> None:
    """Require that the scenarios of the checks exist, in a module that imports nothing from its folder."""
    path = exercise.scenario_file
    try:
        tree = ast.parse(path.read_text(encoding="utf-8"), str(path))
    except (OSError, SyntaxError) as error:
        raise UnusableExercise(f"the scenarios of {exercise.name} cannot be read: {error}") from error
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.level:
            raise UnusableExercise(
                f"{path}, line {node.lineno}, imports from its own folder, but the arena can read only this file of "
                "it: define here what the scenarios need"
            )
    defined = {node.name for node in tree.body if isinstance(node, ast.FunctionDef)}
    wanted = {scenario.name: check.id for check in exercise.checks for scenario in check.on}
    if missing := sorted(wanted.keys() - defined):
        raise UnusableExercise(
            f"{wanted[missing[0]]} of {exercise.name} is judged on the scenario {missing[0]!r}, which {path} does not "
            f"define; it has {', '.join(sorted(defined))}"
        )


@cache
def clauses_in(notebook: Path) -> Mapping[int, str]:
    """Return the clauses by number, each as one line of plain text; empty without a readable notebook."""
    return {
        int(number): " ".join(_MARKUP.sub("", text).split())
        for number, text in _CLAUSE.findall(text_of_cell(notebook, "task"))
    }


def clauses_in_words(clauses: Mapping[int, str], numbers: Sequence[int]) -> str:
    """Return some clauses to read: 'clause 4, “Every request is answered at once …”'."""
    known = [number for number in numbers if number in clauses]
    if len(known) > 1:
        return "clauses " + ", ".join(f"{number} (“{clauses[number]}”)" for number in known)
    return f"clause {known[0]}, “{clauses[known[0]]}”" if known else ""
