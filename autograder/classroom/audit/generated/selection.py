"""Selects the mutants of an exercise to grade: a few of each operator, without the known equivalent ones."""

from __future__ import annotations

import hashlib
from collections import Counter
from collections.abc import Sequence
from fnmatch import fnmatchcase

from autograder.classroom.audit.generated.mutant import Mutant
from autograder.classroom.audit.known_submission import KNOWN, HeaderError
from autograder.engine.exercise import Exercise, exercises_folder

EQUIVALENT = "equivalent.txt"  # in an exercise's known/
USUAL, OF_ROBOTS = 60, 30  # mutants; where the robot moves a grading takes minutes


def usual_number(exercise: Exercise) -> int:
    """Return the default number of mutants to grade."""
    is_light = all(scenario.is_light for check in exercise.checks for scenario in check.on)
    return USUAL if is_light else OF_ROBOTS


def equivalents(exercise: str) -> dict[str, str]:
    """Return the reasons why mutants are equivalent, by (pattern of names, pattern of sentences).

    Raises `HeaderError` for a line that is not “NAME SENTENCE # reason”.
    """
    path = exercises_folder() / exercise / KNOWN / EQUIVALENT
    lines = path.read_text(encoding="utf-8").splitlines() if path.exists() else []
    found = {}
    for number, line in enumerate(lines, start=1):
        patterns, _, reason = (part.strip() for part in line.partition(" # "))
        if line.strip() and not line.startswith("#"):
            if not reason or " " not in patterns:
                raise HeaderError(
                    f"{path}, line {number}: expected “<pattern of names> <pattern of sentences> # why these are no "
                    "mistakes”"
                )
            found[patterns] = reason
    return found


def is_one_of(patterns: str, mutant: Mutant) -> bool:
    """Whether a mutant's name and sentence match a line of `equivalents`."""
    name, _, sentence = patterns.partition(" ")
    return fnmatchcase(mutant.name, name) and fnmatchcase(mutant.sentence, sentence.strip())


def selected(mutants: Sequence[Mutant], number: int, *, seed: int = 0, only: str = "*") -> list[Mutant]:
    """Return up to `number` mutants whose name matches: of each operator in turn, from each base in turn.

    The order within an operator is drawn by the seed and each mutant's own name, so that one more changes no other.
    """
    waiting: dict[str, list[Mutant]] = {}
    for mutant in sorted(mutants, key=lambda mutant: _drawn(mutant, seed)):
        if fnmatchcase(mutant.name, only):
            waiting.setdefault(mutant.operator, []).append(mutant)
    taken: list[Mutant] = []
    from_base: Counter[str] = Counter()
    while len(taken) < number and any(waiting.values()):
        for _, ours in sorted(waiting.items()):
            if ours and len(taken) < number:
                best = min(ours, key=lambda mutant: from_base[mutant.base.stem])
                ours.remove(best)
                from_base[best.base.stem] += 1
                taken.append(best)
    return taken


def _drawn(mutant: Mutant, seed: int) -> str:
    return hashlib.sha256(f"{seed} {mutant.name}".encode()).hexdigest()
