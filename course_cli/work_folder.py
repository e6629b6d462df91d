"""The folder of a student's own notebooks, for a shared installation that students cannot write to."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

from ros_runtime.project import COURSE, WORK_VARIABLE

NAME = "humanoid_course"
PARTS = ("start_here.ipynb", "chapters", "exercises", "docs")


def work_folder() -> Path:
    """Return the folder of this student's notebooks: $COURSE_WORK, else a writable course, else ~/humanoid_course.

    Missing files are copied from the course; existing ones belong to the student and are never changed.

    Raises:
        OSError: the folder cannot be written.
    """
    chosen = os.environ.get(WORK_VARIABLE)
    if not chosen and os.access(COURSE, os.W_OK):
        return COURSE
    folder = Path(chosen).absolute() if chosen else Path.home() / NAME
    if folder != COURSE:
        for part in PARTS:
            _copy_missing(COURSE / part, folder / part)
    return folder


def _copy_missing(source: Path, place: Path) -> None:
    """Copy a file, or the files of a folder, unless they exist already; permissions are not copied."""
    files = sorted(source.rglob("*")) if source.is_dir() else [source]
    for file in files:
        # Files of other types were written by notebooks that somebody ran; they are not part of the course.
        if not file.is_file() or file.suffix not in (".ipynb", ".md", ".png", ".gif", ".svg", ".webp"):
            continue
        copy = place / file.relative_to(source) if source.is_dir() else place
        if not copy.exists():
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(file, copy)
