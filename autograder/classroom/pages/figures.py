"""Statistics on the grades of a class: scores by exercise, the hardest checks, students who need help."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from statistics import median

from autograder.authoring.lesson import in_words
from autograder.engine.verdict import CheckVerdict, Grade

TENTHS = [f"{10 * tenth}–{10 * tenth + 9}" for tenth in range(10)]
FULL = "100"
NEEDS_HELP = 0.6  # share of the points; submissions with less are listed
MAX_TOPICS = 3  # listed for one submission


@dataclass(frozen=True)
class HardCheck:
    """A check's results in a class: how many of the `graded` submissions failed it, and the most frequent advice.

    `lesson` is the lesson of that advice, in words, or ""; `clause` quotes what the task promises.
    """

    id: str
    title: str
    hidden: bool
    failed: int
    not_run: int
    graded: int
    advice: str
    lesson: str
    clause: str

    @property
    def share_failed(self) -> float:
        """The share (0..1) of failures among the submissions on which the check was run."""
        return self.failed / max(1, self.graded - self.not_run)


@dataclass(frozen=True)
class Lesson:
    """A cell of a chapter to which failed checks refer, and the students who failed one, by exercise."""

    words: str
    students: Mapping[str, set[str]]

    @property
    def count(self) -> int:
        """The number of students who failed a check of this lesson in any exercise."""
        return len(set[str]().union(*self.students.values()))


@dataclass(frozen=True)
class ExerciseFigures:
    """The grades of one exercise that have a score, and the number of grades without a score."""

    exercise: str
    graded: Sequence[Grade]
    not_graded: int
    to_mark: int
    hardest: Sequence[HardCheck]

    @property
    def median(self) -> float:
        """The median of the points without deductions for late work, as in the other figures."""
        return median(grade.earned or 0 for grade in self.graded)

    @property
    def max_score(self) -> int:
        """The maximum of points in the exercise."""
        return max(grade.max_score for grade in self.graded)

    @property
    def bins(self) -> Mapping[str, int]:
        """The number of submissions by score, in per cent of the maximum."""
        counts = Counter(_bin(share(grade)) for grade in self.graded)
        return {label: counts[label] for label in [*TENTHS, FULL]}


@dataclass(frozen=True)
class NeedsHelp:
    """A submission with few points, and the checks to discuss first with the student."""

    grade: Grade
    topics: Sequence[CheckVerdict]
    more: int

    @property
    def share(self) -> float:
        """The share (0..1) of the points that the submission has."""
        return share(self.grade)


def exercise_figures(grades: Sequence[Grade]) -> list[ExerciseFigures]:
    """Return the figures of every exercise, in the order in which the exercises first appear in `grades`."""
    by_exercise: dict[str, list[Grade]] = {}
    for grade in grades:
        by_exercise.setdefault(grade.exercise, []).append(grade)
    figures = []
    for exercise, its in by_exercise.items():
        status = Counter(grade.status for grade in its)
        graded = [grade for grade in its if grade.status == "graded"]
        figures.append(
            ExerciseFigures(exercise, graded, status["not graded"], status["to mark"], _hardest(graded))
        )
    return figures


def lessons_to_repeat(grades: Sequence[Grade]) -> list[Lesson]:
    """Return the lessons of all failed checks, those of the most students first."""
    students: dict[str, dict[str, set[str]]] = {}
    for grade in grades:
        for verdict in grade.checks if grade.status == "graded" else ():
            if verdict.status == "failed" and verdict.lesson:
                theirs = students.setdefault(in_words(verdict.lesson), {})
                theirs.setdefault(grade.exercise, set()).add(grade.student)
    lessons = [Lesson(words, who) for words, who in students.items()]
    return sorted(lessons, key=lambda lesson: (-lesson.count, lesson.words))


def who_needs_help(grades: Sequence[Grade]) -> list[NeedsHelp]:
    """Return the graded submissions with less than NEEDS_HELP of the points, in order of their share of the points."""
    few = [grade for grade in grades if grade.status == "graded" and share(grade) < NEEDS_HELP]
    return [_topics(grade) for grade in sorted(few, key=lambda grade: (share(grade), grade.student))]


def cause(grade: Grade) -> str:
    """Return the reason of a grade "not graded" in one line; for a traceback, its first and last line."""
    lines = [line.strip() for line in grade.reason.splitlines() if line.strip()] or ["no check was judged"]
    return f"{lines[0]} {lines[-1]}" if len(lines) > 1 and lines[0].endswith(":") else lines[0]


def share(grade: Grade) -> float:
    """Return the share of the points that a grade has without a deduction for late work, 0..1."""
    return min(1.0, max(0.0, (grade.earned or 0) / max(1, grade.max_score)))


def _bin(part: float) -> str:
    return FULL if part >= 1 else TENTHS[int(10 * part + 1e-9)]


def _hardest(graded: Sequence[Grade]) -> list[HardCheck]:
    """Return the checks that failed, in descending order of the share that failed; ties in the exercise's order."""
    verdicts: dict[str, list[CheckVerdict]] = {}
    for grade in graded:
        for verdict in grade.checks:
            verdicts.setdefault(verdict.id, []).append(verdict)
    checks = [_hard_check(its) for its in verdicts.values()]
    return sorted((check for check in checks if check.failed), key=lambda check: -check.share_failed)


def _hard_check(verdicts: Sequence[CheckVerdict]) -> HardCheck:
    failed = [verdict for verdict in verdicts if is_failed(verdict)]
    advice = Counter((verdict.help, verdict.lesson) for verdict in failed if verdict.help).most_common(1)
    help_, lesson = advice[0][0] if advice else ("", "")
    first = verdicts[0]
    return HardCheck(
        first.id,
        first.title,
        first.hidden,
        len(failed),
        sum(verdict.status == "not run" for verdict in verdicts),
        len(verdicts),
        help_,
        in_words(lesson) if lesson else "",
        (failed or verdicts)[0].promise,
    )


def _topics(grade: Grade) -> NeedsHelp:
    """Return the first failed checks to discuss, because later checks of an exercise build upon earlier ones."""
    failed = [verdict for verdict in grade.checks if is_failed(verdict)]
    return NeedsHelp(grade, failed[:MAX_TOPICS], len(failed[MAX_TOPICS:]))


def is_failed(verdict: CheckVerdict) -> bool:
    """Whether a check failed, or a person gave less than half of a criterion's points."""
    return verdict.status == "failed" or (
        verdict.status == "marked" and verdict.points < verdict.max_points / 2
    )
