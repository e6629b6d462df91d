"""The folder into which a notebook's cells write programs."""

from __future__ import annotations

import os
from pathlib import Path

from ros_runtime.project import WORK

# a kernel starts in this folder; the path is made absolute when the working directory changes
_notebooks = Path()


def notebook_folder() -> Path:
    """Return the folder of the notebook, even after `keep_programs_in` has changed the working directory."""
    return _notebooks


def keep_programs_in(folder: str) -> None:
    """Create a folder beside the notebook and make it the working directory, where cells write and start programs.

    Programs beside the notebook, which earlier versions of the course wrote, stay there and are no longer used.
    """
    global _notebooks
    _notebooks = _notebooks.absolute()
    place = _notebooks / folder
    place.mkdir(parents=True, exist_ok=True)
    os.chdir(place)
    # The path is relative to WORK, because JupyterLab's terminals open there.
    shown = place.relative_to(WORK) if place.is_relative_to(WORK) else folder
    print(f"The programs of this notebook are in {shown}")
    if unused := sorted(path.name for path in _notebooks.glob("*.py")):
        names = ", ".join(unused[:3]) + (", …" if unused[3:] else "")
        print(f"These programs beside the notebook are no longer used: {names}")
