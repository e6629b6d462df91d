"""The record of what a submission earned; every report is made from it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import Any, Literal

CheckStatus = Literal["passed", "failed", "not run", "error", "to mark", "marked"]
GradeStatus = Literal["graded", "not graded", "to mark"]

# Characters of what a verdict says: it may quote a text of a student's, which may be as long as they like.
LONGEST: Mapping[str, int] = {"expected": 500, "observed": 500, "help": 4000}
LENGTH_NOTE = 40  # characters at most of what is put in the place of the rest


@dataclass(frozen=True)
class CheckVerdict:
    """What one check found; `robot_time` is when, in seconds on the arena's clock.

    Of an essay it is what a person gave for one criterion ("marked"), or that nobody has done so yet ("to mark").
    """

    id: str
    title: str
    status: CheckStatus
    points: float
    max_points: int
    expected: str = ""
    observed: str = ""
    help: str = ""
    robot_time: float | None = None
    log: str = ""
    hidden: bool = False

    def __post_init__(self) -> None:
        for name, most in LONGEST.items():
            text = getattr(self, name)
            if len(text) > most + LENGTH_NOTE:  # so that what is read back from a record stays as it is
                object.__setattr__(self, name, f"{text[:most]}…[cut: {len(text):,} characters]")


@dataclass(frozen=True)
class Grade:
    """Every verdict on one submission. One check that could not be judged makes the whole not graded.

    `seed` drew the inputs of its scenarios; None for an essay, and in records of an earlier version.
    """

    exercise: str
    student: str
    isolation: str
    checks: list[CheckVerdict] = field(default_factory=list)
    reason: str = ""
    seed: int | None = None

    @property
    def status(self) -> GradeStatus:
        """'not graded' when the grader failed, never the student; 'to mark' while points are a person's to give."""
        broken = self.reason or not self.checks or any(check.status == "error" for check in self.checks)
        if broken:
            return "not graded"
        return "to mark" if any(check.status == "to mark" for check in self.checks) else "graded"

    @property
    def score(self) -> float | None:
        """The points earned; None when not graded, or not marked yet."""
        return sum(check.points for check in self.checks) if self.status == "graded" else None

    @property
    def max_score(self) -> int:
        """The points there are."""
        return sum(check.max_points for check in self.checks)

    @property
    def all_passed(self) -> bool:
        """Whether the submission was graded and every check passed."""
        return self.status == "graded" and all(check.status == "passed" for check in self.checks)

    def to_json(self) -> dict[str, Any]:
        """Return the record that `--json` writes."""
        return {
            "exercise": self.exercise,
            "student": self.student,
            "status": self.status,
            "isolation": self.isolation,
            "seed": self.seed,
            "score": self.score,
            "max_score": self.max_score,
            "reason": self.reason,
            "checks": [asdict(check) for check in self.checks],
        }

    @classmethod
    def from_json(cls, record: dict[str, Any]) -> Grade:
        """Read back what `to_json` returned."""
        checks = [CheckVerdict(**check) for check in record["checks"]]
        return cls(
            record["exercise"],
            record["student"],
            record["isolation"],
            checks,
            record["reason"],
            record.get("seed"),
        )
