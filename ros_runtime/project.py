"""The folders of the toolkit, of the course's notebooks, and of the student's notebooks."""

from __future__ import annotations

import os
from pathlib import Path

# the toolkit: a clone, or the hidden folder of a student's copy
PROJECT = Path(__file__).resolve().parents[1]
TOOLKIT = ".toolkit"  # name of that hidden folder, which lies beside chapters/ and exercises/
# has start_here.ipynb, chapters/, exercises/, docs/
COURSE = PROJECT.parent if PROJECT.name == TOOLKIT else PROJECT
# If several students share a read-only installation, this variable names each one's own folder of notebooks.
WORK_VARIABLE = "COURSE_WORK"
WORK = Path(os.environ.get(WORK_VARIABLE) or COURSE)
