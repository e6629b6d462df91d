"""A part of a class: some students, some exercises; the grades of the others stay as they are."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeVar

from autograder.classroom.batch.collection import Work
from autograder.classroom.batch.seeds import Seeds
from autograder.engine.verdict import Grade
from ros_runtime.course_error import CourseError

One = TypeVar("One", Work, Grade)


def select(works: Sequence[One], students: Sequence[str], exercises: Sequence[str]) -> list[One]:
    """Return the works or grades of these students for these exercises; an empty sequence selects all.

    Raises:
        CourseError: a name has no submission, or these students handed in none of these exercises.
    """
    for option, wanted, found in (
        ("--student", students, {work.student for work in works}),
        ("--exercise", exercises, {work.exercise for work in works}),
    ):
        if missing := sorted(set(wanted) - found):
            names = ", ".join(sorted(found)[:20]) + (", …" if len(found) > 20 else "")
            raise CourseError(f"{option} {missing[0]}: no submission has this name; there are {names}")
    selected = [
        work
        for work in works
        if (not students or work.student in students) and (not exercises or work.exercise in exercises)
    ]
    if not selected and (students or exercises):
        raise CourseError(f"{', '.join(students)} handed in none of {', '.join(exercises)}")
    return selected


def require_seed(before: Sequence[Grade], seeds: Seeds) -> None:
    """Raise CourseError if a kept grade has another seed than this run would use."""
    if seeds.per_submission:
        return
    other = next((grade for grade in before if grade.seed not in (None, seeds.of(grade.student, {}))), None)
    if other:
        raise CourseError(
            f"{other.student}'s {other.exercise} has a grade with seed {other.seed}, but this run would use seed "
            f"{seeds.of(other.student, {})}; repeat the earlier --seed and --seed-per-student, or grade the whole class"
        )


def with_others(grades: Sequence[Grade], before: Sequence[Grade]) -> list[Grade]:
    """Return the new grades and the earlier ones of other submissions, in order of student and exercise."""
    merged = {(grade.student, grade.exercise): grade for grade in [*before, *grades]}
    return [merged[key] for key in sorted(merged)]
