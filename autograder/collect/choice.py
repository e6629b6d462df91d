"""Which of a student's files is for which exercise, under which name."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import PurePosixPath

from autograder.collect.handed_in import Assignment, HandedIn
from autograder.engine.exercise import all_names, file_names

# What Canvas and browsers put behind the name of a file that they have already.
_AGAIN = re.compile(r"(?P<stem>.+?)(?:-\d+| ?\(\d+\))")


@dataclass
class Choice:
    """The files to keep, by student and exercise and by their new name, and a sentence for each that is left aside."""

    works: dict[tuple[str, str], dict[str, HandedIn]] = field(default_factory=dict)
    left_aside: list[str] = field(default_factory=list)


def choose(files: Sequence[HandedIn], assignment: Assignment) -> Choice:
    """Assign every file to an exercise by its name, or to the download's exercise; the last one handed in counts."""
    choice = Choice()
    known = _known_names()
    named: set[tuple[str, str, str]] = set()  # files that are called as the exercise wants it
    for one in sorted(files, key=lambda one: (one.student, one.turn, str(one.file.path))):
        exercise, name, exact = _place_of(one, known, assignment)
        only = one.exercise or assignment.exercise
        if not exercise:
            choice.left_aside.append(f"{one.file.path} is of no exercise ({one.student})")
            continue
        if only and exercise != only:
            choice.left_aside.append(f"{one.file.path} is of {exercise}, not of {only} ({one.student})")
            continue
        work = choice.works.setdefault((one.student, exercise), {})
        if (before := work.get(name)) and not exact and (one.student, exercise, name) in named:
            choice.left_aside.append(
                f"{one.file.path}: {before.file.path} is called as it should be ({one.student})"
            )
            continue
        if before:
            choice.left_aside.append(
                f"{before.file.path} was handed in again as {one.file.path} ({one.student})"
            )
        work[name] = one
        if exact:
            named.add((one.student, exercise, name))
    return choice


def _known_names() -> dict[str, tuple[str, str]]:
    """The exercise and the right name of every file that students write, by that name in small letters."""
    names: dict[str, tuple[str, str]] = {}
    for exercise in all_names():
        for name in (f"{exercise}.ipynb", *file_names(exercise)):
            names[name.lower()] = (exercise, name)
    return names


def _place_of(
    one: HandedIn, known: dict[str, tuple[str, str]], assignment: Assignment
) -> tuple[str, str, bool]:
    """Return the exercise, the name its file gets there, and whether the student called it so."""
    path = PurePosixPath(one.name)
    again = _AGAIN.fullmatch(path.stem)
    for stem in (path.stem, again["stem"] if again else path.stem):
        if found := known.get(f"{stem}{path.suffix}".lower()):
            return (*found, True)
    exercise = one.exercise or assignment.exercise
    possible = [
        f"{exercise}.ipynb",
        *(file_names(exercise) if exercise and len(file_names(exercise)) == 1 else ()),
    ]
    if exercise and f"{exercise}{path.suffix}" in possible:
        return exercise, f"{exercise}{path.suffix}", False
    return "", "", False
