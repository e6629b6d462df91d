"""The part of a grade that a student may see: of a hidden check its clause and result; nothing before it is final."""

from __future__ import annotations

from dataclasses import replace

from autograder.classroom.nbgrader_bridge.cell_names import cell_names, hidden_help
from autograder.engine.verdict import CheckVerdict, Grade


def student_view(grade: Grade) -> Grade:
    """Return the grade without titles, inputs and outputs of hidden checks, and without the grader's own errors.

    A grade that is not graded or not completely marked gets no verdicts, because they may still change.
    """
    if grade.status == "not graded":
        return replace(grade, checks=[], reason="")
    if grade.status == "to mark":
        return replace(grade, checks=[replace(each, status="to mark", points=0) for each in grade.checks])
    names = cell_names(grade.checks)
    return replace(grade, checks=[_seen(verdict, names[verdict.id]) for verdict in grade.checks])


def _seen(verdict: CheckVerdict, name: str) -> CheckVerdict:
    if not verdict.hidden:
        return verdict
    passed = verdict.status == "passed"
    return CheckVerdict(
        name,
        name.replace("hidden_", "Hidden check "),
        "passed" if passed else "failed",
        verdict.points,
        verdict.max_points,
        help="" if passed else hidden_help(verdict.promise),
        hidden=True,
    )
