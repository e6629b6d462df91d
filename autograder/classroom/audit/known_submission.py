"""A submission whose verdict is known beforehand and stated in a header.

The header of a program is its first docstring, the header of a patch is the text before the diff, and the header of a
folder is its about.md.

correct:  Style: how it is written
faulty:   Fault: the mistake (M2)            M2 is the number of the misconception, if it has one
          Caught by: check_id, check_id      each must fail
          Also fails: check_id               may fail as a consequence of the same fault
          On g1: check_id, check_id          must fail on that robot; "Caught by" then may; or "nothing", and why
hostile:  Attack: what it tries
          Outcome: what happens
          Caught by: …, Also fails: …        as above, or
          Passes: nothing it did not do      the program also solves the task; the attack must not change the grade
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fnmatch import fnmatch
from pathlib import Path
from typing import Literal, get_args

from autograder.classroom.audit.fault_patch import DOCSTRING, SUFFIX, header_of, whole_program
from autograder.engine.exercise import exercises_folder, file_names
from autograder.engine.submission import Submission, read_submission
from ros_runtime.course_error import CourseError

KNOWN = "known"  # the folder of known submissions in an exercise's folder
ABOUT = "about.md"
NOTHING = "nothing"  # what another robot shows of some faults

Kind = Literal["correct", "faulty", "hostile"]

_KEY = re.compile(r"(Style|Fault|Attack|Outcome|Caught by|Also fails|On \w+|Passes): *(.*)")
_HEADLINE: Mapping[Kind, str] = {"correct": "Style", "faulty": "Fault", "hostile": "Attack"}


@dataclass(frozen=True)
class KnownSubmission:
    """A submission and the checks that must (`caught_by`) and may (`also_fails`) fail for it."""

    exercise: str
    kind: Kind
    path: Path
    about: str
    caught_by: tuple[str, ...] = ()
    also_fails: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        """The name in tables, such as faulty/no_cancel_callback."""
        return f"{self.kind}/{self.path.stem}"

    def read(self) -> Submission:
        """Return the whole submission; raises `CourseError` when a patch does not apply."""
        if self.path.suffix == SUFFIX:
            (file_name,) = file_names(self.exercise)
            return Submission(self.exercise, self.name, {file_name: whole_program(self.path)})
        return read_submission(self.path, self.exercise, student=self.name)


def known_submissions(exercise: str, *, only: str = "*", robot: str | None = None) -> list[KnownSubmission]:
    """Read the submissions in <exercise>/known/<kind>/; `only` is a glob on kind/stem or stem.

    Each is a program, a patch, or a folder where students of the exercise write several files. With another `robot`,
    `caught_by` has the checks that must fail on it.
    """
    folders = [exercises_folder() / exercise / KNOWN / kind for kind in get_args(Kind)]
    return [
        read_known_submission(path, robot)
        for place in folders
        for path in sorted(place.glob("[!_]*"))
        if (path.is_dir() or path.suffix in (".py", SUFFIX))
        and (fnmatch(path.stem, only) or fnmatch(f"{path.parent.name}/{path.stem}", only))
    ]


def known_submission(exercise: str, name: str) -> KnownSubmission:
    """Return the submission of this name, such as faulty/sleeps; raises `CourseError` unless there is exactly one."""
    kind, _, stem = name.rpartition("/")
    found = known_submissions(exercise, only=name)
    if len(found) != 1:
        names = ", ".join(known.name for known in found) or "none"
        raise CourseError(f"expected one submission of {exercise} called {kind or '*'}/{stem}; found {names}")
    return found[0]


def read_known_submission(path: Path, robot: str | None = None) -> KnownSubmission:
    """Read the header of <exercise>/known/<kind>/<name>, as it is for a robot; raises `CourseError`."""
    kind, exercise = _kind(path), path.parents[2].name
    header = _parse(_header_text(path))
    headline = _HEADLINE[kind]
    if not header.get(headline):
        raise CourseError(f'{_header_place(path)} must have a line "{headline}: …"')
    known = KnownSubmission(
        exercise, kind, path, header[headline], _ids(header, "Caught by"), _ids(header, "Also fails")
    )
    _require_an_expectation(known, header)
    if on_robot := header.get(f"On {robot}"):
        caught_by = () if on_robot.startswith(NOTHING) else _ids(header, f"On {robot}")
        known = replace(known, caught_by=caught_by, also_fails=(*known.also_fails, *known.caught_by))
    return known


def require_known_checks(known: KnownSubmission, check_ids: Sequence[str]) -> None:
    """Raise `CourseError` when a header names a check that the exercise does not have."""
    named = {*known.caught_by, *known.also_fails}
    if unknown := sorted(named - set(check_ids)):
        raise CourseError(
            f"{known.path} names {', '.join(unknown)}; "
            f"the checks of {known.exercise} are {', '.join(check_ids)}"
        )


def _header_text(path: Path) -> str:
    if path.is_dir():
        about = path / ABOUT
        return about.read_text(encoding="utf-8") if about.exists() else ""
    text = path.read_text(encoding="utf-8")
    if path.suffix == SUFFIX:
        return header_of(text)
    found = DOCSTRING.match(text)
    return found[1] if found else ""


def _header_place(path: Path) -> str:
    if path.is_dir():
        return f"{ABOUT} in {path}"
    return f"the beginning of {path}" if path.suffix == SUFFIX else f"the first docstring of {path}"


def _kind(path: Path) -> Kind:
    for kind in get_args(Kind):
        if path.parent.name == kind:
            return kind
    raise CourseError(
        f"{path} is in the folder {path.parent.name!r}; expected one of {', '.join(get_args(Kind))}"
    )


def _parse(docstring: str) -> dict[str, str]:
    """Return the text after each key; a text may run over several lines, up to an empty one."""
    header: dict[str, str] = {}
    key = ""
    for line in map(str.strip, docstring.splitlines()):
        if match := _KEY.fullmatch(line):
            key = match[1]
            header[key] = match[2]
        elif not line:
            key = ""
        elif key:
            header[key] = f"{header[key]} {line}".strip()
    return header


def _ids(header: Mapping[str, str], key: str) -> tuple[str, ...]:
    return tuple(word.strip() for word in header.get(key, "").split(",") if word.strip())


def _require_an_expectation(known: KnownSubmission, header: Mapping[str, str]) -> None:
    if known.kind == "correct":
        if known.caught_by or known.also_fails:
            raise CourseError(f"{known.path} is in correct/, but its header says that a check fails")
    elif known.kind == "faulty" and not known.caught_by:
        raise CourseError(f'{known.path} needs a line "Caught by: check_id"')
    elif known.kind == "hostile" and not header.get("Outcome"):
        raise CourseError(f'{known.path} needs a line "Outcome: …"')
    elif known.kind == "hostile" and bool(known.caught_by) == ("Passes" in header):
        raise CourseError(
            f'{known.path} needs either "Caught by: check_id" or "Passes: nothing it did not do"'
        )
    if overlap := set(known.caught_by) & set(known.also_fails):
        raise CourseError(f"{known.path} names {', '.join(sorted(overlap))} twice")
