"""An exercise as the controller sees it: its checks, visible and hidden, in order."""

from __future__ import annotations

import importlib
import importlib.util
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from autograder.checks import Check

FOLDER = Path(__file__).parent / "exercises"


class UnknownExercise(Exception):
    """There is no exercise of that name."""


@dataclass(frozen=True)
class Exercise:
    """The checks of one exercise; the hidden ones are absent from the students' bundle."""

    name: str
    checks: Sequence[Check]
    has_hidden_checks: bool

    @property
    def file_names(self) -> tuple[str, ...]:
        """The files a student writes."""
        return file_names(self.name)

    @property
    def scenario_module(self) -> str:
        """The module an arena imports the scenarios from."""
        return f"autograder.exercises.{self.name}.scenarios"

    def max_score(self) -> int:
        """The points of all its checks."""
        return sum(check.points for check in self.checks)


def exercise_names() -> list[str]:
    """Name the exercises there are."""
    return sorted(folder.name for folder in FOLDER.iterdir() if (folder / "checks.py").exists())


def file_names(exercise: str) -> tuple[str, ...]:
    """Return the names of the files a student writes: one program, unless the exercise's package lists FILES.

    Raises :class:`UnknownExercise` naming those there are.
    """
    _require_known(exercise)
    package = importlib.import_module(f"autograder.exercises.{exercise}")
    return getattr(package, "FILES", (f"{exercise}.py",))


def load_exercise(name: str, *, hidden: bool) -> Exercise:
    """Load an exercise with or without its hidden checks; raises :class:`UnknownExercise` naming those there are."""
    _require_known(name)
    package = f"autograder.exercises.{name}"
    checks = list(importlib.import_module(f"{package}.checks").CHECKS.checks)
    has_hidden = importlib.util.find_spec(f"{package}.hidden") is not None
    if hidden and has_hidden:
        checks += importlib.import_module(f"{package}.hidden").CHECKS.checks
    _require_sound(name, checks)
    return Exercise(name, checks, has_hidden)


def _require_known(name: str) -> None:
    if name not in exercise_names():
        raise UnknownExercise(f"there is no exercise {name!r}; there are {', '.join(exercise_names())}")


def _require_sound(name: str, checks: Sequence[Check]) -> None:
    """Each check has an id of its own and needs only checks that come before it."""
    seen: set[str] = set()
    for check in checks:
        if check.id in seen:
            raise ValueError(f"two checks of {name} are called {check.id}")
        if missing := set(check.needs) - seen:
            raise ValueError(f"{check.id} of {name} needs {sorted(missing)}, which do not come before it")
        seen.add(check.id)
