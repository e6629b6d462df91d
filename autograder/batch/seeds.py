"""The seeds of a batch: one for all students, or one each."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass


@dataclass(frozen=True)
class Seeds:
    """What draws the inputs of scenarios: `batch` itself, or a number made of it and the student's name."""

    batch: int = 0
    per_student: bool = False

    def of(self, student: str) -> int:
        """Return a student's seed, the same on every machine: 0 to 2³² - 1 where there is one each."""
        if not self.per_student:
            return self.batch
        return int.from_bytes(hashlib.sha256(f"{self.batch} {student}".encode()).digest()[:4], "big")


ONE_FOR_ALL = Seeds()
