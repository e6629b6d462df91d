"""Where the clone, or the students' copy, lies, and where a student's own notebooks do."""

from __future__ import annotations

import os
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[1]
# Of an installation that several students share and none may write, each has notebooks of their own elsewhere.
WORK_VARIABLE = "COURSE_WORK"
WORK = Path(os.environ.get(WORK_VARIABLE) or PROJECT)
