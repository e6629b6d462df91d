"""Assigns students' files to exercises, and chooses the file to grade for each."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import PurePath

from autograder.classroom.batch.collection import files_of_exercises
from autograder.classroom.collect.handed_in import Assignment, HandedIn
from autograder.engine.hand_in import Candidate, Names, choose_work, merged

PROGRAMS = (".ipynb", ".py")
ARCHIVES = (".zip", ".gz", ".tgz", ".bz2", ".xz", ".tar", ".7z", ".rar")


@dataclass
class Choice:
    """The submissions to keep, by student and exercise, and a sentence on each file that is left aside."""

    works: dict[tuple[str, str], Candidate] = field(default_factory=dict)
    left_aside: list[str] = field(default_factory=list)
    timestamps: dict[tuple[str, str], str] = field(default_factory=dict)


def choose(files: Sequence[HandedIn], assignment: Assignment) -> Choice:
    """Assign every file to an exercise, by its name or the options; choose one of several like `engine.hand_in`."""
    choice = Choice()
    names = Names(files_of_exercises())
    found: dict[tuple[str, str], list[Candidate]] = {}
    for one in files:
        only = one.exercise or assignment.exercise
        folders = [home for part in one.file.path.parts[:-1] if (home := names.exercise_of(part))]
        named = names.of(one.name) or (names.any_of(only, one.name) if only else None)
        if not named and one.file.path.suffix.lower() in ARCHIVES:
            choice.left_aside.append(
                f"{one.file.path} is an archive, and archives are not opened: unpack the download, then "
                f"this archive into the same folder ({one.student})"
            )
        elif not named:
            kinds = (
                [".ipynb", *dict.fromkeys(PurePath(name).suffix for name in names.files[only])]
                if only
                else PROGRAMS
            )
            choice.left_aside.append(f"{one.file.path} {_why_no_work(one.name, kinds)} ({one.student})")
        elif only and named.exercise != only:
            choice.left_aside.append(
                f"{one.file.path} is for {named.exercise}, not for {only} ({one.student})"
            )
        elif folders and folders[-1] != named.exercise:
            choice.left_aside.append(f"{one.file.path} is in the folder of {folders[-1]} ({one.student})")
        else:
            depth = len(one.file.path.parts) - bool(folders)
            candidate = Candidate(
                named.exercise,
                one.file.path,
                {named.name: one.file},
                one.turn,
                depth,
                one.file.changed,
                named.copy,
            )
            key = one.student, named.exercise
            found.setdefault(key, []).append(candidate)
            choice.timestamps[key] = max(choice.timestamps.get(key, ""), one.timestamp)
    for key, candidates in sorted(found.items()):
        choice.works[key], others = choose_work(merged(candidates))
        choice.left_aside += [f"{line} ({key[0]})" for line in others]
    return choice


def _why_no_work(name: str, kinds: Sequence[str]) -> str:
    """Return why a file belongs to no exercise, as the end of a sentence; `kinds` are the endings of programs."""
    if PurePath(name).suffix.lower() in kinds:
        return "is not named like an exercise's file"
    return f"is no notebook or program ({', '.join(kinds)})"
