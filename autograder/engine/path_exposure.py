"""Refuses to grade where a sandbox would show what students may not see.

A sandbox shows the system's programs and the interpreter by folder (`isolation/bubblewrap.py`, `python_paths.py`). A
project under /usr/src, where some Docker images put one, would be shown with them: solutions, hidden checks, and other
students' work.
"""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path

from autograder.engine.submission_arena import student_paths
from autograder.isolation.bubblewrap import SYSTEM_PATHS
from ros_runtime.course_error import COULD_NOT, CourseError


class HiddenChecksRefused(CourseError):
    """Hidden checks would be exposed to the submission on this machine."""

    exit_status = COULD_NOT


def require_hidden(hidden: Iterable[Path], shown: Iterable[str | Path] | None = None) -> None:
    """Require that no sandbox shows these files and folders.

    Args:
        hidden: solutions, hidden checks, submissions, grades; they need not exist yet.
        shown: what sandboxes show; None: what students' sandboxes show on this machine.

    Raises:
        HiddenChecksRefused: one of them lies in something that is shown.
    """
    shown = [*SYSTEM_PATHS, *student_paths()] if shown is None else list(shown)
    for path in hidden:
        for folder in shown:
            if Path(os.path.realpath(path)).is_relative_to(os.path.realpath(folder)):
                raise HiddenChecksRefused(
                    f"nothing is graded: {path} lies in {folder}, which students' programs can read, and they may not "
                    "see what is there; move it to a folder of its own, such as /srv or your home"
                )
