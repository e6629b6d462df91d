"""Gradescope's results.json for one submission.

Format: https://gradescope-autograders.readthedocs.io/en/latest/specs/, "Output Format". If neither the file nor its
tests have a score, Gradescope gives the submission no score.
"""

from __future__ import annotations

from typing import Any, Literal

from pydantic import BaseModel, ConfigDict

from autograder.classroom.export.published import (
    Options,
    printable,
    publish,
    text_without_score,
    why_no_score,
)
from autograder.engine.verdict import CheckVerdict, Grade
from autograder.report.table import verdict_text

Visibility = Literal["visible", "hidden", "after_due_date", "after_published"]
FILE = "results.json"


class Test(BaseModel):
    """One entry of the list of tests. Gradescope shows its text as plain text, never as HTML."""

    model_config = ConfigDict(extra="forbid")

    score: float
    max_score: float
    status: Literal["passed", "failed"]
    name: str
    name_format: Literal["text"] = "text"
    number: str
    output: str
    output_format: Literal["text"] = "text"
    visibility: Visibility


class Results(BaseModel):
    """The whole file. Only instructors see the grader's stdout, which never contains a student's output."""

    model_config = ConfigDict(extra="forbid")

    score: float | None = None
    output: str = ""
    output_format: Literal["text"] = "text"
    visibility: Visibility = "visible"
    stdout_visibility: Visibility = "hidden"
    tests: list[Test] | None = None
    extra_data: dict[str, Any] | None = None

    def text(self) -> str:
        """Return the file's content."""
        return self.model_dump_json(exclude_none=True, indent=2) + "\n"


def render(grade: Grade, options: Options) -> str:
    """Return the file for a grade. It has the titles of hidden checks, which Gradescope shows only to instructors."""
    if why_no_score(grade):
        return Results(output=text_without_score(grade)).text()
    published = publish(grade, options.hidden)
    tests = [_test(check, str(i), "visible") for i, check in enumerate(published.checks, start=1)]
    tests += [_test(check, f"H{i}", "hidden") for i, check in enumerate(published.hidden, start=1)]
    return Results(
        score=published.score,
        output="\n".join(filter(None, (published.hidden_sum, published.late))),
        tests=tests,
        extra_data={"isolation": grade.isolation},
    ).text()


def _test(check: CheckVerdict, number: str, visibility: Visibility) -> Test:
    return Test(
        score=check.points,
        max_score=check.max_points,
        status="passed" if check.points >= check.max_points else "failed",
        name=printable(check.title),
        number=number,
        output=printable(verdict_text(check)),
        visibility=visibility,
    )
