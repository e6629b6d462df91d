"""The first step inside an arena: enter the arena's clock.

Run as `python -m autograder.arena.clocked_start EVENTS_FD` with the specification as JSON on stdin. The clock is a
preloaded library, so it must be there before a process is: this one makes it and replaces itself by the agent. It
imports next to nothing, because every arena pays for it.
"""

from __future__ import annotations

import os
import sys
import tempfile
from pathlib import Path

from ros_runtime.clock.scaled_clock import ScaledClock
from ros_runtime.environment import ros_environment
from ros_runtime.own_network import loopback_variables

CLOCK_PAGE = "ARENA_CLOCK_PAGE"
SPEC_FILE = "ARENA_SPEC_FILE"


def main() -> None:
    """Become the agent under the clock."""
    folder = Path(tempfile.mkdtemp(prefix="arena-"))
    (folder / "spec.json").write_text(sys.stdin.read())
    clock = ScaledClock.create(folder / "clock")
    environment = {
        **os.environ,
        **ros_environment(),
        **loopback_variables(),
        **clock.environment(),
        CLOCK_PAGE: str(folder / "clock"),
        SPEC_FILE: str(folder / "spec.json"),
    }
    os.execve(sys.executable, [sys.executable, "-m", "autograder.arena.agent", *sys.argv[1:]], environment)


if __name__ == "__main__":
    main()
