"""A student's own notebooks, where the installation is shared and read-only."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

from ros_runtime.project import PROJECT, WORK_VARIABLE

NAME = "humanoid_course"
PARTS = ("start_here.ipynb", "chapters", "exercises", "docs")


def work_folder() -> Path:
    """Where this student's notebooks lie: COURSE_WORK, else the project if it can be written, else ~/humanoid_course.

    What is not there yet is copied; a file that is there is the student's and stays as it is.

    Raises:
        OSError: nothing can be written there.
    """
    chosen = os.environ.get(WORK_VARIABLE)
    if not chosen and os.access(PROJECT, os.W_OK):
        return PROJECT
    folder = Path(chosen).absolute() if chosen else Path.home() / NAME
    if folder != PROJECT:
        for part in PARTS:
            _copy_missing(PROJECT / part, folder / part)
    return folder


def _copy_missing(source: Path, place: Path) -> None:
    """Copy a file, or the files of a folder, that are not there; without the rights of a shared original."""
    files = sorted(source.rglob("*")) if source.is_dir() else [source]
    for file in files:
        # What notebooks have written beside themselves belongs to whoever ran them there.
        if not file.is_file() or file.suffix not in (".ipynb", ".md", ".png", ".gif", ".svg", ".webp"):
            continue
        copy = place / file.relative_to(source) if source.is_dir() else place
        if not copy.exists():
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(file, copy)
