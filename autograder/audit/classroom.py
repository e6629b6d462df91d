"""A class whose grades are known beforehand: each student hands in one known submission for each exercise.

Of an essay it is known that it waits for a person.
"""

from __future__ import annotations

import json
import random
from collections.abc import Mapping, Sequence
from itertools import cycle
from pathlib import Path

from autograder.audit.known_essay import KnownEssay, known_essays, surprises_in_essay
from autograder.audit.known_submission import Kind, KnownSubmission, known_submission, known_submissions
from autograder.audit.run import AuditedRun, for_any_fault
from autograder.batch.records import GRADES
from autograder.engine.exercise import essay_names, load_exercise
from autograder.engine.verdict import Grade

SUBMITTED, GRADED, LABELS = "submitted", "graded", "labels.json"  # in the folder of a class
SHARES: Mapping[Kind, float] = {"correct": 0.7, "faulty": 0.2, "hostile": 0.1}

Labels = dict[str, dict[str, str]]  # of a student's exercises, the names of known submissions


class CannotRehearse(Exception):
    """There is no class in the folder, or it cannot be made there; the message says why."""


def make_class(
    folder: Path,
    exercises: Sequence[str],
    students: int,
    *,
    seed: int = 0,
    shares: Mapping[Kind, float] = SHARES,
) -> Labels:
    """Write the submissions of a class, and labels.json, which says what each of them is.

    Args:
        folder: which is created, and must not hold a class yet.
        exercises: for each of which every student hands something in.
        students: how many.
        seed: of the choice; the same seed makes the same class.
        shares: of correct, faulty and hostile submissions. Where an exercise has none of a kind, it is a faulty or a
            correct one.

    Returns:
        The labels.

    Raises:
        CannotRehearse: the folder holds a class, or an exercise has no known submissions.
    """
    if (folder / SUBMITTED).exists():
        raise CannotRehearse(f"{folder / SUBMITTED} exists; name a new folder, or remove it first")
    choice = random.Random(seed)
    essays = essay_names()
    decks = {
        exercise: _Essays(exercise) if exercise in essays else _Deck(known_submissions(exercise), choice)
        for exercise in exercises
    }
    labels: Labels = {}
    for number in range(1, students + 1):
        student = f"student_{number:0{len(str(students))}}"
        kinds = choice.choices(list(shares), list(shares.values()), k=len(exercises))
        handed_in = {
            exercise: decks[exercise].draw(kind) for exercise, kind in zip(exercises, kinds, strict=True)
        }
        for exercise, known in handed_in.items():
            place = folder / SUBMITTED / student / exercise
            place.mkdir(parents=True)
            for name, text in known.read().sources.items():
                (place / name).write_text(text, encoding="utf-8")
        labels[student] = {exercise: known.name for exercise, known in handed_in.items()}
    (folder / LABELS).write_text(json.dumps(labels, indent=2) + "\n")
    return labels


class _Deck:
    """Known submissions of an exercise, dealt one after the other, so that a class of enough students has them all."""

    def __init__(self, submissions: Sequence[KnownSubmission], choice: random.Random) -> None:
        if not submissions:
            raise CannotRehearse("an exercise without known submissions cannot be rehearsed")
        self._of: dict[Kind, list[KnownSubmission]] = {}
        self._dealt: dict[Kind, int] = {}
        for known in choice.sample(submissions, len(submissions)):
            self._of.setdefault(known.kind, []).append(known)

    def draw(self, kind: Kind) -> KnownSubmission:
        """Return the next one of a kind."""
        kind = next(one for one in (kind, "faulty", "correct", "hostile") if one in self._of)
        self._dealt[kind] = self._dealt.get(kind, -1) + 1
        return self._of[kind][self._dealt[kind] % len(self._of[kind])]


class _Essays:
    """The known answers to an essay, dealt in the same way; none of them is right, faulty or hostile."""

    def __init__(self, exercise: str) -> None:
        if not (known := known_essays(exercise)):
            raise CannotRehearse(f"there is no answer to the essay {exercise}")
        self._known = cycle(known)

    def draw(self, _kind: Kind) -> KnownEssay:
        """Return the next one."""
        return next(self._known)


def surprises(folder: Path) -> dict[str, list[str]]:
    """Compare the grades of a class with its labels.

    Returns:
        What is not as known, as sentences, by "student's exercise (name of the known submission)"; a submission
        without a grade is one of them.

    Raises:
        CannotRehearse: there is no class in the folder, or it was not graded.
    """
    for needed, how in ((LABELS, "make the class"), (f"{GRADED}/{GRADES}", "grade it")):
        if not (folder / needed).is_file():
            raise CannotRehearse(f"{folder / needed} is missing: {how} first")
    labels: Labels = json.loads((folder / LABELS).read_text())
    grades = {
        (grade.student, grade.exercise): grade
        for grade in map(Grade.from_json, json.loads((folder / GRADED / GRADES).read_text()))
    }
    essays = essay_names()
    found: dict[str, list[str]] = {}
    for student, handed_in in labels.items():
        for exercise, name in handed_in.items():
            grade = grades.get((student, exercise))
            if not grade:
                words = ["it has no grade"]
            elif exercise in essays:
                words = surprises_in_essay(grade)
            else:
                any_fault = for_any_fault(load_exercise(exercise, hidden=True))
                words = AuditedRun(known_submission(exercise, name), 0, grade, 0.0, any_fault).surprises()
            if words:
                found[f"{student}'s {exercise} ({name})"] = words
    return found
