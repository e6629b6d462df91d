"""Classroom 50's result.json for one submission: whole points only, and no file for a submission without a score.

Format: schemas/result-v1.schema.json of https://github.com/foundation50/classroom50. In a job that Classroom 50 runs,
environment variables identify the submission. Outside such a job, the tag says that a person entered the grade.
"""

from __future__ import annotations

from typing import Literal

from pydantic import BaseModel, ConfigDict, Field

from autograder.classroom.export.published import (
    CannotExpress,
    Options,
    number,
    printable,
    publish,
    text_without_score,
)
from autograder.engine.verdict import Grade

FILE = "result.json"
_CLASSROOM = "humanoid-course"  # the default name of the classroom


class Test(BaseModel):
    """One entry of the list of tests."""

    model_config = ConfigDict(extra="forbid", populate_by_name=True)

    name: str = Field(serialization_alias="test-name", min_length=1)
    passed: bool
    score: int = Field(ge=0)
    max_score: int = Field(serialization_alias="max-score", ge=0)


class Result(BaseModel):
    """The whole file."""

    model_config = ConfigDict(extra="forbid", populate_by_name=True)

    schema_: Literal["classroom50/result/v1"] = Field(
        default="classroom50/result/v1", serialization_alias="schema"
    )
    classroom: str = Field(min_length=1)
    assignment: str = Field(min_length=1)
    assignment_type: Literal["individual", "group"] = "individual"
    owner: str = Field(min_length=1)
    submission: str = Field(pattern="^submit/")
    commit: str = Field(min_length=1)
    release: str = Field(min_length=1)
    review: str = Field(min_length=1)
    datetime: str
    score: int = Field(ge=0)
    max_score: int = Field(serialization_alias="max-score", ge=0)
    tests: list[Test]


def notes(options: Options) -> list[str]:
    """Return sentences on files that Classroom 50 may refuse."""
    if options.classroom or options.environment.get("CLASSROOM"):
        return []
    return [
        f"Classroom 50 accepts these files only for a classroom named {_CLASSROOM}; for another, give --classroom NAME"
    ]


def render(grade: Grade, options: Options) -> str:
    """Return the file for a graded submission.

    Raises:
        CannotExpress: the submission has no score, or its score has half points.
    """
    if grade.status != "graded":
        raise CannotExpress(text_without_score(grade))
    published = publish(grade, options.hidden)
    tests = [
        Test(
            name=printable(check.title),
            passed=check.points >= check.max_points,
            score=_whole(check.points),
            max_score=check.max_points,
        )
        for check in published.checks
    ]
    if published.hidden:
        points, most = _whole(published.hidden_points), _whole(published.hidden_max_points)
        tests.append(Test(name=published.hidden_sum, passed=points >= most, score=points, max_score=most))
    given = options.environment if options.environment.get("SUBMISSION_TAG") else {}
    tag = given.get("SUBMISSION_TAG") or f"submit/manual-{options.graded_at:%Y-%m-%dT%H-%M-%SZ}"
    return (
        Result(
            classroom=_classroom(options),
            assignment=given.get("ASSIGNMENT") or options.assignments.get(grade.exercise, grade.exercise),
            owner=given.get("USERNAME") or grade.student,
            submission=tag,
            commit=given.get("COMMIT_URL") or tag,
            release=given.get("RELEASE_URL") or tag,
            review=given.get("REVIEW_URL") or given.get("COMMIT_URL") or tag,
            datetime=f"{options.graded_at:%Y-%m-%dT%H:%M:%SZ}",
            score=_whole(published.score),
            max_score=_whole(published.max_score),
            tests=tests,
        ).model_dump_json(by_alias=True, indent=2)
        + "\n"
    )


def _classroom(options: Options) -> str:
    return options.classroom or options.environment.get("CLASSROOM") or _CLASSROOM


def _whole(points: float) -> int:
    if not float(points).is_integer():
        raise CannotExpress(
            f"{number(points)} points, but Classroom 50 accepts only whole points: enter the grade by hand"
        )
    return int(points)
