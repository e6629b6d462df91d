"""Compile the preloaded library of the scaled clock.

Run as `python -m ros_runtime.workarounds.scaled_clock.compile_library TARGET`.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

SOURCE = Path(__file__).with_name("scaled_clock.c")


def compile_library(target: Path) -> None:
    """Compile scaled_clock.c into the shared library `target`; $CC chooses the compiler (default: cc).

    Raises:
        OSError: there is no compiler. Arenas on this machine then run at scale 1.
        subprocess.CalledProcessError: the source does not compile, as with a glibc before 2.30; same consequence.
    """
    compiler = os.environ.get("CC", "cc")
    flags = ["-std=c11", "-O2", "-Wall", "-Wextra", "-shared", "-fPIC", "-pthread"]
    subprocess.run([compiler, *flags, "-o", target, SOURCE, "-ldl"], check=True)


if __name__ == "__main__":
    compile_library(Path(sys.argv[1]))
