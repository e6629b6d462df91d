"""PrairieLearn's results.json for one submission: at most 1 MB, and a score from 0 to 1.

Format: https://prairielearn.readthedocs.io/en/latest/externalGrading/. A submission that is not gradable costs the
student no attempt.
"""

from __future__ import annotations

from pydantic import BaseModel, ConfigDict, Field

from autograder.engine.verdict import CheckVerdict, Grade
from autograder.export.options import Options
from autograder.export.published import printable, publish, why_no_score, words_for_students
from autograder.report.verdict_text import LONGEST_TEXT, verdict_text

FILE = "results.json"
MOST_BYTES = 1_000_000


class Image(BaseModel):
    """A picture; we send none."""

    label: str
    url: str


class Test(BaseModel):
    """One entry of the list of tests."""

    model_config = ConfigDict(extra="forbid")

    name: str
    description: str = ""
    points: float
    max_points: float
    message: str = ""
    output: str = ""
    images: list[Image] = []


class Results(BaseModel):
    """The whole file."""

    model_config = ConfigDict(extra="forbid")

    gradable: bool
    score: float | None = Field(default=None, ge=0, le=1)
    message: str = ""
    output: str = ""
    images: list[Image] = []
    tests: list[Test] = []

    def text(self) -> str:
        """Return the file's content."""
        return self.model_dump_json(exclude_none=True, indent=2) + "\n"


def render(grade: Grade, options: Options) -> str:
    """Return the file for a grade; what the checks say is cut where it would be longer than PrairieLearn reads."""
    if why_no_score(grade):
        return Results(gradable=False, message=words_for_students(grade)).text()
    longest = LONGEST_TEXT
    while len((text := _results(grade, options, longest).text()).encode()) > MOST_BYTES:
        longest //= 2
    return text


def _results(grade: Grade, options: Options, longest: int) -> Results:
    published = publish(grade, options.hidden)
    tests = [_test(check, longest) for check in published.checks]
    if published.hidden:
        points, most = published.hidden_points, published.hidden_max_points
        tests.append(Test(name=published.hidden_sum, points=points, max_points=most))
    share = published.score / published.max_score if published.max_score else 0.0
    return Results(gradable=True, score=min(max(share, 0.0), 1.0), tests=tests)


def _test(check: CheckVerdict, longest: int) -> Test:
    return Test(
        name=printable(check.title),
        points=check.points,
        max_points=check.max_points,
        output=printable(verdict_text(check, longest)),
    )
