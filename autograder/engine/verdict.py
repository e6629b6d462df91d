"""The record of what a submission earned; every report is made from it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import Any, Literal, get_args

CheckStatus = Literal["passed", "failed", "not run", "error", "to mark", "marked"]
GradeStatus = Literal["graded", "not graded", "to mark"]

# Longest texts of a verdict, in characters: they may quote a student's text of any length.
LONGEST: Mapping[str, int] = {"expected": 500, "observed": 500, "help": 4000}
LENGTH_NOTE = 40  # characters, at most, of the note that replaces the cut part


@dataclass(frozen=True)
class CheckVerdict:
    """The result of one check; `robot_time` is the time of the observation, s on the arena's clock.

    `promise` quotes the clause that the check judges: 'clause 4, “Every request …”'. `lesson` is what a failure refers
    to, CHAPTER#cell or a URL; "" for none.
    For an essay: the points that a person gave for one criterion ("marked"), or none yet ("to mark").
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
    promise: str = ""
    lesson: str = ""

    def __post_init__(self) -> None:
        for name, most in LONGEST.items():
            text = getattr(self, name)
            # a text that was cut before, read from a record, is not cut again
            if len(text) > most + LENGTH_NOTE:
                object.__setattr__(self, name, f"{text[:most]}…[cut: {len(text):,} characters]")


@dataclass(frozen=True)
class Late:
    """What late work loses: the points, and a sentence for the student that explains them."""

    points: float
    reason: str


@dataclass(frozen=True)
class Grade:
    """Every verdict on one submission. One check that could not be judged makes the submission not graded.

    `seed` drew the inputs of its scenarios; None for an essay, and in records of an earlier version. `program` is the
    fingerprint of what was graded; "" where it could not be read. `late`: None for work in time without an extension.
    """

    exercise: str
    student: str
    isolation: str
    checks: list[CheckVerdict] = field(default_factory=list)
    reason: str = ""
    seed: int | None = None
    program: str = ""
    late: Late | None = None

    @property
    def status(self) -> GradeStatus:
        """'not graded' if the grader failed, never due to the student; 'to mark' until a person gives the points."""
        broken = self.reason or not self.checks or any(check.status == "error" for check in self.checks)
        if broken:
            return "not graded"
        return "to mark" if any(check.status == "to mark" for check in self.checks) else "graded"

    @property
    def why_not_graded(self) -> str:
        """The grader's reason in one line: that of the submission, or of the first check that it could not judge."""
        reasons = [self.reason, *(check.help for check in self.checks if check.status == "error")]
        first = next((reason.splitlines()[0] for reason in reasons if reason), "")
        return first.removeprefix("Not graded: ")

    @property
    def earned(self) -> float | None:
        """The points of the checks; None when not graded, or not marked yet."""
        return sum(check.points for check in self.checks) if self.status == "graded" else None

    @property
    def score(self) -> float | None:
        """The points earned without those that late work loses; None when not graded, or not marked yet."""
        if self.earned is None or not self.late or not self.late.points:
            return self.earned
        return round(max(0.0, self.earned - self.late.points), 2)

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
            "program": self.program,
            "earned": self.earned,
            "late": asdict(self.late) if self.late else None,
            "score": self.score,
            "max_score": self.max_score,
            "reason": self.reason,
            "checks": [asdict(check) for check in self.checks],
        }

    @classmethod
    def from_json(cls, record: Any) -> Grade:
        """Read back what `to_json` returned.

        Raises:
            ValueError: the record is malformed, or has impossible points.
        """
        try:
            checks = [CheckVerdict(**check) for check in record["checks"]]
            names = ("exercise", "student", "isolation", "reason")
            exercise, student, isolation, reason = (_text(record[name]) for name in names)
            program = _text(record.get("program", ""))
            late = Late(**record["late"]) if record.get("late") else None
        except (KeyError, TypeError) as error:
            raise ValueError(f"this is no grade: {type(error).__name__}: {error}") from error
        for check in checks:
            _require_sound(check)
        seed = record.get("seed")
        if seed is not None and not isinstance(seed, int):
            raise ValueError(f"a seed is a whole number, not {str(seed)[:100]!r}")
        if late and not (_is_number(late.points) and late.points >= 0 and _text(late.reason)):
            raise ValueError(f"late work cannot lose {late.points!r} points"[:300])
        return cls(exercise, student, isolation, checks, reason, seed, program, late)


def _require_sound(check: CheckVerdict) -> None:
    """Require the types and the points that a verdict can have; raises ValueError."""
    for name in ("id", "title", "expected", "observed", "help", "log", "promise", "lesson"):
        _text(getattr(check, name))
    if check.status not in get_args(CheckStatus):
        raise ValueError(f"{check.id[:100]!r} has no status {str(check.status)[:100]!r}")
    if not all(_is_number(each) for each in (check.points, check.max_points)) or not (
        0 <= check.points <= check.max_points
    ):
        raise ValueError(
            f"{check.id[:100]!r} cannot have {check.points!r} of {check.max_points!r} points"[:300]
        )
    if not (check.robot_time is None or _is_number(check.robot_time)) or not isinstance(check.hidden, bool):
        raise ValueError(f"{check.id[:100]!r}: robot_time must be a number or null, and hidden true or false")


def _text(value: Any) -> str:
    if not isinstance(value, str):
        raise ValueError(f"expected a text, not {str(value)[:100]!r}")
    return value


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)
