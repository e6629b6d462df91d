"""The options of an export: facts that a platform needs and a grade does not contain."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import datetime
from pathlib import Path

from autograder.classroom.export.published import HiddenPolicy


@dataclass(frozen=True)
class Options:
    """The choices for one export.

    Attributes:
        graded_at: when the grades were written, UTC.
        hidden: whether hidden checks are summed up or shown in full.
        roster: a table of the class, exported from the platform.
        assignments: the platform's id of an exercise's assignment, by the exercise's name.
        classroom: the name of the Classroom 50 classroom.
        environment: the process's variables, for jobs that run on the platform itself.
    """

    graded_at: datetime
    hidden: HiddenPolicy = "hide"
    roster: Path | None = None
    assignments: Mapping[str, str] = field(default_factory=dict)
    classroom: str = ""
    environment: Mapping[str, str] = field(default_factory=dict)
