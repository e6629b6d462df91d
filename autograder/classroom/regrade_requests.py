"""Students' regrade requests: reads them, keeps their state in a table, and collects the evidence for the answer."""

from __future__ import annotations

import re
import shlex
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import astuple, dataclass, fields
from pathlib import Path

from rich.console import Console

from autograder.atomic_file import write_atomically
from autograder.classroom.batch.records import GRADES, read_grades
from autograder.classroom.batch.request import BatchRequest
from autograder.classroom.batch.source_files import SOURCES
from autograder.classroom.class_grading.once import grade_once
from autograder.classroom.export.tables import Table, csv_text, read_table, text_cell
from autograder.classroom.nbgrader_bridge.generated_cells import HIDDEN, cell_names
from autograder.classroom.pages.pages import FOR_INSTRUCTOR, FOR_STUDENTS, student_view
from autograder.engine.submission import Submission
from autograder.engine.verdict import CheckVerdict, Grade
from autograder.recording.kept import FOLDER as RECORDINGS
from autograder.recording.kept import SUFFIX
from autograder.recording.replay.recording import Recording
from ros_runtime.course_error import CourseError

TABLE = "requests.csv"
STATES = ("open", "answered", "changed", "refused")
MAX_FORM_BYTES = 100_000  # of a student's form
_FORMS = (".md", ".txt")
_FIELD = re.compile(r"\W*(student|exercise|check|why)\W*:[* ]*(.*)", re.IGNORECASE)


class UnusableRequests(CourseError):
    """The requests cannot be read; the message names the file, and what is expected."""


@dataclass(frozen=True)
class RegradeRequest:
    """One request, as a row of requests.csv.

    Attributes:
        check: the id, or the title, of a check, for hidden checks "Hidden check 3"; "" for the whole grade.
        state: "open", or the decision that a person has written: "answered", "changed" or "refused".
        by: the person who decided.
        second_run: the result of grading the same program again with the same seed; "" before it has run.
    """

    number: int
    student: str
    exercise: str
    check: str
    why: str
    state: str = "open"
    by: str = ""
    second_run: str = ""

    @property
    def content(self) -> tuple[str, ...]:
        """What the student asked; two requests with the same content are one."""
        return (self.student, self.exercise, self.check, self.why)


_HEADING = [field.name for field in fields(RegradeRequest)]


def read_state(folder: Path) -> list[RegradeRequest]:
    """Read requests.csv, in which a person writes the decisions.

    Raises:
        UnusableBatch: the file is not a table.
    """
    path = folder / TABLE
    if not path.exists():
        return []
    found = []
    for row in _columns(read_table(path), path, _HEADING):
        if not row["number"].isdigit() or row["state"] not in STATES:
            raise UnusableRequests(
                f"{path}: {row['number']!r}, {row['state']!r}: expected a number, and one of the states "
                f"{', '.join(STATES)}"
            )
        found.append(RegradeRequest(**(row | {"number": int(row["number"])})))  # type: ignore[arg-type]
    return found


def write_state(folder: Path, requests: Sequence[RegradeRequest]) -> None:
    """Write all requests, with their states, to requests.csv."""
    rows = [[text_cell(str(cell)) for cell in astuple(request)] for request in requests]
    write_atomically(folder / TABLE, csv_text(_HEADING, rows))


def new_requests(
    inbox: Path, known: Sequence[RegradeRequest]
) -> tuple[list[RegradeRequest], list[CourseError]]:
    """Read the forms and tables in a folder, or one table.

    Returns the requests that are not known yet, and an error for each file that cannot be used.
    """
    paths = sorted(inbox.iterdir()) if inbox.is_dir() else [inbox]
    contents = {request.content for request in known}
    number = max((request.number for request in known), default=0)
    found: list[RegradeRequest] = []
    unusable: list[CourseError] = []
    for path in paths:
        if path.suffix not in (*_FORMS, ".csv") or path.is_symlink() or path.name == TABLE:
            continue
        try:
            rows = list(_rows_of(path)) if path.suffix == ".csv" else [_form(path)]
        except CourseError as error:
            unusable.append(error)
            continue
        for asked in rows:
            request = RegradeRequest(number + 1, **asked)
            if request.content not in contents:
                contents.add(request.content)
                found.append(request)
                number += 1
    return found, unusable


def _rows_of(path: Path) -> Iterator[dict[str, str]]:
    return _columns(read_table(path), path, ["student", "exercise", "check", "why"])


def _columns(table: Table, path: Path, names: Sequence[str]) -> Iterator[dict[str, str]]:
    where = {name: table.index(name) for name in names}
    if missing := [name for name, index in where.items() if index is None]:
        raise UnusableRequests(
            f"{path} has no column {missing[0]!r}; expected {', '.join(names)}, found {', '.join(table.heading)}"[
                :500
            ]
        )
    for row in table.rows:
        yield {
            name: row[index].strip().removeprefix("'") for name, index in where.items() if index is not None
        }


def _form(path: Path) -> dict[str, str]:
    """Read a form with the lines student:, exercise:, check: and why:; the reason may have several lines."""
    asked: dict[str, list[str]] = {}
    lines: list[str] = []
    with path.open(encoding="utf-8", errors="replace") as file:
        text = file.read(MAX_FORM_BYTES)
    for line in text.splitlines():
        if (match := _FIELD.fullmatch(line)) and (name := match[1].lower()) not in asked:
            lines = asked.setdefault(name, [match[2].strip()])
        else:
            lines.append(line.strip())
    if missing := [name for name in ("student", "exercise") if not asked.get(name, [""])[0]]:
        raise UnusableRequests(
            f"{path} has no line {missing[0]!r}: expected student:, exercise:, check: and why:"
        )
    return {
        name: " ".join(filter(None, asked.get(name, []))) for name in ("student", "exercise", "check", "why")
    }


@dataclass(frozen=True)
class Evidence:
    """A request, the grade that it is about, and the same program graded again with the same seed.

    `recordings` are those of the second run in which the check was judged.
    """

    request: RegradeRequest
    before: Grade
    again: Grade
    recordings: Sequence[Path] = ()

    @property
    def differences(self) -> Sequence[str]:
        """A line for each check whose verdict is another one; empty if both runs agree, or one was not graded."""
        if "not graded" in (self.before.status, self.again.status):
            return []
        old = {check.id: check for check in self.before.checks}
        return [
            f"{check.id}: {was.status} before, {check.status} now"
            for check in self.again.checks
            if (was := old.get(check.id)) and was.status != check.status
        ]

    @property
    def result(self) -> str:
        """The result of the second run, for the table."""
        if self.differences:
            return f"DIFFERS: {'; '.join(self.differences)}"
        before, now = _points(self.before), _points(self.again)
        return f"same: {now}" if before == now else f"{before} before, {now} now"

    def reply(self) -> str:
        """Return the draft of the reply as Markdown, with the evidence for the instructor below it."""
        request, check = self.request, find_check(self.again, self.request.check)
        name = cell_names(self.again.checks)[check.id] if check else ""
        seen = next((each for each in student_view(self.again).checks if each.id == name), None)
        again = f"{request.number}/graded"
        before, now = _points(self.before), _points(self.again)
        lines = [
            f"# Request {request.number}: {request.student}, {request.exercise}, {request.check or 'the whole grade'}",
            f"The student wrote: “{request.why}”" if request.why else "The student gave no reason.",
            "## Draft of the reply",
            f"I graded the program that you handed in again (fingerprint {self.again.program}), with the same inputs: "
            f"{now}{', as before' if now == before else f'; before: {before}'}.",
            *([self.before.late.reason] if self.before.late else []),
            *(_in_words(seen) if seen else ["The page of your exercise has all checks."]),
            "## For you",
            f"- second run: {self.result}",
            *(
                ["- **A grade that differs between two runs is a fault of the grader: please report it.**"]
                * bool(self.differences)
            ),
            f"- all verdicts: {again}/{FOR_INSTRUCTOR}/{request.student}/{request.exercise}.html; the student's page: "
            f"{again}/{FOR_STUDENTS}/{request.student}/{request.exercise}.html",
            *(
                ["- recordings of the second run; --film film.webp makes a film of one:"]
                * bool(self.recordings)
            ),
            *(f"      ./course replay {shlex.quote(str(path))}{_around(check)}" for path in self.recordings),
            f"- then write the state ({', '.join(STATES[1:])}) and your name to {TABLE}. No command changes the grade: "
            "to change points, use Formgrader. If it was not graded, or after you corrected a wrong file or a time in "
            "dates.yaml, run the same ./course grade with --resume.",
        ]
        return "\n\n".join(lines) + "\n"


def find_check(grade: Grade, asked: str) -> CheckVerdict | None:
    """Return the check that a student means: its id, its title, or "Hidden check 3"; None if there is none."""
    wanted = " ".join(asked.lower().split())
    names = cell_names(grade.checks)
    for check in grade.checks:
        shown = names[check.id]
        if wanted in (check.id, check.title.lower(), shown, shown.replace(HIDDEN, "hidden check ")):
            return check
    return None


def collect_evidence(request: RegradeRequest, graded: Path, folder: Path, jobs: int) -> Evidence:
    """Grade the submission of a request again, as it was graded, with recordings, and write the draft of the reply.

    Raises:
        UnusableRequests: there is no such grade, program or check, or the program has changed since.
    """
    before = next(
        (
            grade
            for grade in read_grades(graded / GRADES)
            if (grade.student, grade.exercise) == (request.student, request.exercise)
        ),
        None,
    )
    if before is None:
        raise UnusableRequests(f"{graded / GRADES} has no grade of {request.student} for {request.exercise}")
    if request.check and before.checks and find_check(before, request.check) is None:
        titles = "; ".join(check.title for check in student_view(before).checks)
        raise UnusableRequests(f"{request.exercise} has no check {request.check!r}; it has: {titles}"[:1000])
    program = graded / SOURCES / request.exercise / request.student
    sources = _texts(program)
    if (
        before.program
        and Submission(request.exercise, request.student, sources).fingerprint != before.program
    ):
        raise UnusableRequests(f"{program} is not the program that was graded (fingerprint {before.program})")
    place, out = folder / str(request.number), folder / str(request.number) / "graded"
    for name, text in sources.items():
        write_atomically(place / "submitted" / request.student / request.exercise / name, text)
    grade_once(
        Console(quiet=True),
        BatchRequest(submitted=place / "submitted", out=out, jobs=jobs, seed=before.seed, record=True),
    )
    again = read_grades(out / GRADES)[0]
    check = find_check(again, request.check)
    recordings = [
        path
        for path in sorted((out / RECORDINGS / request.student / request.exercise).glob(f"*{SUFFIX}"))
        if check and any(moment.check == check.id for moment in Recording.read(path).moments)
    ]
    evidence = Evidence(request, before, again, recordings)
    write_atomically(place / "reply.md", evidence.reply())
    return evidence


def _texts(folder: Path) -> Mapping[str, str]:
    paths = sorted(folder.glob("*")) if folder.is_dir() else []
    if not paths:
        raise UnusableRequests(f"{folder} has no program; expected the sources/ of `course grade`")
    return {path.name: path.read_text(encoding="utf-8", errors="surrogateescape") for path in paths}


def _points(grade: Grade) -> str:
    """Return the points without a deduction for late work, which a second run does not have."""
    return "not graded" if grade.earned is None else f"{grade.earned:g} of {grade.max_score} points"


def _around(check: CheckVerdict | None) -> str:
    return f" --around {check.id}" if check and not check.hidden else ""


def _at(check: CheckVerdict) -> str:
    return "" if check.robot_time is None else f" (at {check.robot_time:.1f} s)"


def _in_words(check: CheckVerdict) -> Sequence[str]:
    """Return paragraphs on a verdict as the student may read it."""
    return [
        f"The check “{check.title}” {check.status}: {check.points:g} of {check.max_points} points.",
        *([f"It judges {check.promise}."] if check.promise else []),
        *([f"Expected: {check.expected}"] if check.expected else []),
        *([f"Observed: {check.observed}{_at(check)}"] if check.observed else []),
        *([f"Next: {check.help}"] if check.help else []),
    ]
