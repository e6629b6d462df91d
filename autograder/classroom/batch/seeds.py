"""The seeds of a batch, which draw the inputs of hidden checks.

A new seed is drawn for each batch unless one is given, so the inputs of one batch do not reveal those of the next.
"""

from __future__ import annotations

import hashlib
import secrets
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from autograder.classroom.batch.collection import Work

_HASHED_SIZE = 65536  # bytes at the beginning of each file that a seed is hashed from


@dataclass(frozen=True)
class Seeds:
    """The seeds that draw the inputs of scenarios: the batch's seed, or one hashed from it for each submission.

    Attributes:
        batch: the seed of the batch.
        per_student: hash it with the student's name, so that each student has another seed.
        per_submission: hash it with the name and the program, so that a changed program has another seed.
    """

    batch: int = 0
    per_student: bool = False
    per_submission: bool = False

    def of(self, student: str, sources: Mapping[str, str]) -> int:
        """Return a submission's seed, the same on every machine: the batch's seed, or a hash from 0 to 2³² - 1."""
        if not (self.per_student or self.per_submission):
            return self.batch
        text = f"{self.batch} {student}"
        if self.per_submission:
            text += "".join(f"\0{name}\0{source}" for name, source in sorted(sources.items()))
        return int.from_bytes(hashlib.sha256(text.encode()).digest()[:4], "big")

    def in_words(self) -> str:
        """Return the seeds in words, for the instructor."""
        if self.per_submission:
            return f"{self.batch}, hashed with each submission"
        return f"{self.batch}, hashed with each student's name" if self.per_student else str(self.batch)


ONE_FOR_ALL = Seeds()


def drawn_seed() -> int:
    """Return an unpredictable seed."""
    return secrets.randbits(32)


def seed_of_submissions(works: Sequence[Work]) -> int:
    """Return a hash of all submissions as seed: the same on machines with the same folder, and unknown to students."""
    digest = hashlib.sha256()
    for work in sorted(works, key=lambda work: (work.student, work.exercise)):
        digest.update(f"{work.student}\0{work.exercise}\0".encode())
        for path in work.files():
            digest.update(_beginning(path))
    return int.from_bytes(digest.digest()[:4], "big")


def _beginning(path: Path) -> bytes:
    """The size and the first bytes of a regular file; b"" if it cannot be read."""
    if path.is_symlink() or not path.is_file():
        return b""
    try:
        with path.open("rb") as file:
            return f"{path.stat().st_size} ".encode() + file.read(_HASHED_SIZE)
    except OSError:
        return b""
