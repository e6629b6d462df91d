"""Gradescope's container: its folders, and the protection of results.json against students' programs.

Layout: https://gradescope-autograders.readthedocs.io/en/latest/specs/, "File Hierarchy". The grader runs as root, and
the student's program runs as another user, so only the grader can write the results and read checks and uploads.
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

from autograder.atomic_file import write_atomically
from autograder.classroom.export.gradescope import FILE, Results
from autograder.isolation.arena_spec import ISOLATION_VARIABLE, Kind
from autograder.isolation.availability import Isolation, available_isolation, with_another_user


class CannotGrade(Exception):
    """The container cannot grade, through no fault of the student; the message says why."""


@dataclass(frozen=True)
class Container:
    """The folder /autograder, or another folder with the same layout."""

    root: Path

    @property
    def submission(self) -> Path:
        """The folder with the student's upload."""
        return self.root / "submission"

    @property
    def results(self) -> Path:
        """The file that Gradescope reads."""
        return self.root / "results" / FILE

    def remove_results(self) -> None:
        """Remove the results of an earlier run, so that its score is not attributed to this one."""
        self.results.parent.mkdir(parents=True, exist_ok=True)
        self.results.unlink(missing_ok=True)

    def restrict_to_root(self, *more: Path) -> None:
        """Make uploads, results, submission metadata and the folders `more` accessible to root only."""
        for folder in (self.submission, self.results.parent, *more):
            if folder.is_dir():
                os.chmod(folder, 0o700)
        # The metadata contains names, addresses, and the results of earlier uploads.
        metadata = self.root / "submission_metadata.json"
        if metadata.is_file():
            os.chmod(metadata, 0o600)

    def write(self, results: Results) -> None:
        """Write results.json atomically."""
        write_atomically(self.results, results.text())


def isolation_here() -> Isolation:
    """Return the best isolation that this container has: namespaces, else another user.

    Raises:
        CannotGrade: neither is available, so a student's program could write its own score.
    """
    best = available_isolation()
    if best.kind is Kind.NONE and os.environ.get(ISOLATION_VARIABLE) != Kind.NONE:
        why = best.reason
        best = with_another_user()
        if best.kind is Kind.NONE:
            raise CannotGrade(f"{why}; {best.reason}")
    if best.kind is Kind.NONE:
        raise CannotGrade(best.reason)
    return best
