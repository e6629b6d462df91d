"""A copy of a student's program that reports which of its lines decided something, and when.

The copy runs in an arena as any submission. The lines to report are known from the text: where a program looks whether
a cancel is requested, ends a goal, stops the robot, fills a response, or requests a cancel itself.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass

from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.classroom.audit.generated.field_assignments import field_assignments
from autograder.classroom.audit.generated.program import Edits, last_name
from autograder.classroom.questions.student_program import StudentProgram

SEEN, STOPS, ASKS = "cancel seen", "stop", "cancel_goal_async"
ENDS = ("canceled", "succeed", "abort")
_REPORT = re.compile(r"@line (\d{1,7}) (.+)")
# In the copy: reports the line and returns the value. A cancel that is not requested, and a Twist after which the robot
# moves or still stands, are not reported.
_REPORTER = f'''
def _at_line(line, what, value):
    says = what != "{SEEN}" or value
    if what == "{STOPS}" and (says := hasattr(value, "linear")):
        moves = any(getattr(part, axis) for part in (value.linear, value.angular) for axis in "xyz")
        moved, _at_line.moves = getattr(_at_line, "moves", False), moves
        says = moved and not moves
    if says:
        __import__("os").write(2, f"@line {{line}} {{what}}\\n".encode())
    return value
'''


@dataclass(frozen=True)
class Mark:
    """At `t` (s, on the arena's clock) the program was at `line`, where the expression `node` did `what`."""

    t: float
    line: int
    what: str
    node: ast.expr


def traced(program: StudentProgram) -> str:
    """Return the copy's source. Its lines have other numbers, but it reports the numbers of the student's program."""
    edits: Edits = {}
    for what, node in _places(program):
        edits.setdefault(node, f"_at_line({node.lineno}, {what!r}, {ast.unparse(node)})")
    first = next((one for one in program.tree.body if not _must_be_first(one)), None)
    if first:
        edits[first] = f"{_REPORTER}\n{program.changed(edits, first)}"
    return program.changed(edits)


def marks(program: StudentProgram, run: Transcript) -> list[Mark]:
    """Return what the copy reported in a run, in order of time; lines that the copy cannot report are left out."""
    places = {(str(node.lineno), what): node for what, node in _places(program)}
    reports = [(one.t, _REPORT.fullmatch(one.text)) for one in run.all(ev.NodeOutput)]
    found = [(t, report[2], places.get((report[1], report[2]))) for t, report in reports if report]
    return [Mark(t, node.lineno, what, node) for t, what, node in found if node]


def _places(program: StudentProgram) -> Iterator[tuple[str, ast.expr]]:
    for name in program.every(ast.Attribute):
        if isinstance(name.ctx, ast.Load) and name.attr in (*ENDS, ASKS, "is_cancel_requested"):
            yield SEEN if name.attr == "is_cancel_requested" else name.attr, name
    for call in program.every(ast.Call):
        if last_name(call) == "publish" and call.args:
            yield STOPS, call.args[0]
    for assigned in field_assignments(program) if program.callbacks("service") else ():
        if assigned.value:
            yield assigned.field.rpartition(".")[2], assigned.value


def _must_be_first(statement: ast.stmt) -> bool:
    is_text = isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Constant)
    return is_text or (isinstance(statement, ast.ImportFrom) and statement.module == "__future__")
