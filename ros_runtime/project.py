"""The folder of the clone or of the student's copy, and the folder of the student's notebooks."""

from __future__ import annotations

import os
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[1]
# If several students share a read-only installation, this variable names each student's folder of notebooks.
WORK_VARIABLE = "COURSE_WORK"
WORK = Path(os.environ.get(WORK_VARIABLE) or PROJECT)
