"""Refuses to grade where sandboxes could read files that students must not see.

A sandbox can read the folders of the system and of the interpreter (`isolation/bubblewrap.py`, `python_paths.py`). In
a project under /usr/src, where some Docker images put it, that includes solutions, hidden checks and other students'
work.
"""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path

from autograder.engine.submission_arena import student_paths
from autograder.isolation.bubblewrap import SYSTEM_PATHS
from ros_runtime.course_error import CommandFailed


def require_hidden(hidden: Iterable[Path], shown: Iterable[str | Path] | None = None) -> None:
    """Require that no sandbox can read these files and folders.

    Args:
        hidden: solutions, hidden checks, submissions, grades; they need not exist yet.
        shown: the paths that sandboxes can read; None: those that students' sandboxes can read on this machine.

    Raises:
        CourseError: a hidden path lies in a readable one.
    """
    shown = [*SYSTEM_PATHS, *student_paths()] if shown is None else list(shown)
    for path in hidden:
        for folder in shown:
            if Path(os.path.realpath(path)).is_relative_to(os.path.realpath(folder)):
                raise CommandFailed(
                    f"nothing is graded: {path} lies in {folder}, which students' programs can read; "
                    "move it to a folder that they cannot, such as one in /srv or in your home"
                )
