"""check50's JSON for one submission, as `check50 --output json` writes it.

Format: https://cs50.readthedocs.io/projects/check50/en/latest/json_specification/. There, null also stands for a
check that was skipped because another one failed; here it stands for "not graded" alone.
"""

from __future__ import annotations

from typing import Any

from pydantic import BaseModel, ConfigDict

from autograder.engine.verdict import CheckVerdict, Grade
from autograder.export.options import Options
from autograder.export.published import (
    Published,
    number,
    printable,
    publish,
    why_no_score,
    words_for_students,
)

FILE = "check50.json"
VERSION = "3.4.0"  # of check50, whose format this is
HIDDEN = "hidden_checks"


class Cause(BaseModel):
    """Why a check did not pass; `expected` and `actual` only where both are known."""

    model_config = ConfigDict(extra="forbid")

    rationale: str
    help: str | None = None
    expected: str | None = None
    actual: str | None = None


class Result(BaseModel):
    """The result of one check."""

    model_config = ConfigDict(extra="forbid")

    name: str
    description: str
    passed: bool | None
    log: list[str] = []
    cause: dict[str, Any] | None = None
    data: dict[str, Any] = {}
    dependency: str | None = None


class Report(BaseModel):
    """The whole file."""

    model_config = ConfigDict(extra="forbid")

    slug: str
    results: list[Result]
    version: str = VERSION


def render(grade: Grade, options: Options) -> str:
    """Return the file for a grade."""
    slug = options.assignments.get(grade.exercise, grade.exercise)
    results = _unjudged(grade) if why_no_score(grade) else _judged(publish(grade, options.hidden))
    return Report(slug=slug, results=results).model_dump_json(indent=2) + "\n"


def _judged(published: Published) -> list[Result]:
    results = [_result(check) for check in published.checks]
    if published.hidden:
        points, most = published.hidden_points, published.hidden_max_points
        passed = points >= most
        results.append(
            Result(
                name=HIDDEN,
                description="hidden checks",
                passed=passed,
                cause=None if passed else _cause(rationale=published.hidden_sum),
                data={"points": points, "max_points": most},
            )
        )
    return results


def _result(check: CheckVerdict) -> Result:
    passed = check.points >= check.max_points
    return Result(
        name=check.id,
        description=printable(check.title),
        passed=passed,
        log=[] if passed else [printable(line) for line in check.log.splitlines()],
        cause=None if passed else _cause_of(check),
        data={"points": number(check.points), "max_points": check.max_points},
    )


def _cause_of(check: CheckVerdict) -> dict[str, Any]:
    if check.status == "not run":
        return _cause(rationale="This check was not made.", help=printable(check.help) or None)
    return _cause(
        rationale=printable(check.observed) or "The check did not pass.",
        help=printable(check.help) or None,
        expected=printable(check.expected) or None,
        actual=printable(check.observed) if check.expected else None,
    )


def _unjudged(grade: Grade) -> list[Result]:
    """Every visible check without a verdict; where none is known, the exercise as one."""
    shown = [(check.id, check.title) for check in grade.checks if not check.hidden]
    if any(check.hidden for check in grade.checks):
        shown.append((HIDDEN, "hidden checks"))
    cause = _cause(rationale=words_for_students(grade))
    return [
        Result(name=name, description=printable(title), passed=None, cause=cause)
        for name, title in shown or [(grade.exercise, grade.exercise)]
    ]


def _cause(**words: Any) -> dict[str, Any]:
    return Cause(**words).model_dump(exclude_none=True) | {"help": words.get("help")}
