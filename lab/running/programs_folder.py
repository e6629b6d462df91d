"""The folder of the programs that a notebook's cells write."""

from __future__ import annotations

import os
from pathlib import Path

from ros_runtime.project import WORK

_notebooks = Path()  # a kernel begins there; absolute as soon as it leaves


def notebook_folder() -> Path:
    """Return the folder of the notebook, also after `keep_programs_in`."""
    return _notebooks


def keep_programs_in(folder: str) -> None:
    """Make the folder beside the notebook and go there: cells write, find and start files in it.

    Programs beside the notebook, as earlier versions of the course wrote them, stay where they are, unused.
    """
    global _notebooks
    _notebooks = _notebooks.absolute()
    place = _notebooks / folder
    place.mkdir(parents=True, exist_ok=True)
    os.chdir(place)
    # JupyterLab's terminals open in WORK.
    shown = place.relative_to(WORK) if place.is_relative_to(WORK) else folder
    print(f"The programs of this notebook are in {shown}")
    if unused := sorted(path.name for path in _notebooks.glob("*.py")):
        names = ", ".join(unused[:3]) + (", …" if unused[3:] else "")
        print(f"Others are beside the notebook, which doesn't use them: {names}")
