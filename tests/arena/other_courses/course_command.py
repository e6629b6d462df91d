"""The console script, as people run it."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

COURSE = Path(sys.executable).with_name("course")


def course(*arguments: str | Path, cwd: Path | None = None) -> subprocess.CompletedProcess[str]:
    """Run `course` in a wide terminal."""
    return subprocess.run(
        [COURSE, *map(str, arguments)],
        cwd=cwd,
        env={**os.environ, "COLUMNS": "300"},
        capture_output=True,
        text=True,
        check=False,
        timeout=300,
    )
