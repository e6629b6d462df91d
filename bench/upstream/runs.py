"""Runs a file of rclpy's tests in a process of its own, and reads how each test went."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from bench.upstream.modes import Mode
from bench.upstream.reporter import OUTCOMES_VARIABLE
from ros_runtime.project import PROJECT
from ros_runtime.ros_domain import ReservedDomain

DEADLINE = 300.0  # s for a file; the longest takes about 30
# Those of the course, of this shell's ROS and of a pytest around this one are not the tests' business.
_FOREIGN = ("ROS_", "RMW_", "RCUTILS_", "RCLPY_", "FASTRTPS_", "FASTDDS_", "PYTEST_", "SCALED_CLOCK")
NOT_RUN = "not run"


@dataclass(frozen=True)
class FileRun:
    """One file of tests in one mode.

    Attributes:
        outcomes: "passed", "failed", "skipped" or "not run", by test.
        reasons: the end of what pytest says, by test that failed.
        ended: how the process ended, if not by itself after its last test.
        passed_alone: tests that passed only when they ran again, alone.
    """

    file: str
    mode: Mode
    outcomes: dict[str, str]
    reasons: dict[str, str]
    wall_s: float
    ended: str | None = None
    passed_alone: Sequence[str] = ()

    def number(self, outcome: str) -> int:
        """How many tests went so."""
        return Counter(self.outcomes.values())[outcome]


def run_file(path: Path, mode: Mode, only: Sequence[str] = ()) -> FileRun:
    """Run a file, or the tests of it that `only` names."""
    chosen = [f"{path}::{name}" for name in only] or [str(path)]
    # pytest's own files of configuration, and the plugins of ROS, stay out.
    command = [sys.executable, "-m", "pytest", "-q", "-c", os.devnull, f"--rootdir={path.parent}"]
    command += ["-p", "no:cacheprovider", "-p", "no:launch_testing", "-p", "no:launch_ros", "-p", "no:xdist"]
    command += ["-p", "bench.upstream.reporter", *chosen]
    with tempfile.TemporaryDirectory() as folder, ReservedDomain() as domain_id:
        lines = Path(folder, "outcomes")
        own = {name: value for name, value in os.environ.items() if not name.startswith(_FOREIGN)}
        environment = own | mode.environment(Path(folder), domain_id)
        environment |= {OUTCOMES_VARIABLE: str(lines), "ROS_LOG_DIR": folder, "PYTHONPATH": str(PROJECT)}
        started = time.monotonic()
        ended = _end_of(command, folder, environment)
        wall_s = time.monotonic() - started
        outcomes, reasons = _read(lines)
    return FileRun(path.name, mode, outcomes, reasons, wall_s, ended)


def _end_of(command: Sequence[str], folder: str, environment: dict[str, str]) -> str | None:
    """Run it; returns how it ended, if not with 0 (all passed) or 1 (some failed)."""
    try:
        done = subprocess.run(
            command,
            cwd=folder,
            env=environment,
            capture_output=True,
            text=True,
            check=False,
            timeout=DEADLINE,
        )
    except subprocess.TimeoutExpired:
        return f"still ran after {DEADLINE:g} s"
    if done.returncode in (0, 1):
        return None
    return f"status {done.returncode}: {(done.stdout + done.stderr)[-1500:]}"


def _read(lines: Path) -> tuple[dict[str, str], dict[str, str]]:
    outcomes: dict[str, str] = {}
    reasons: dict[str, str] = {}
    for text in lines.read_text(encoding="utf-8").splitlines() if lines.exists() else ():
        line = json.loads(text)
        for name in line.get("collected", ()):
            outcomes[name] = NOT_RUN
        # A test that passed and could not be taken down has failed.
        if "test" in line and outcomes.get(line["test"]) != "failed":
            outcomes[line["test"]] = line["outcome"]
            if line["outcome"] == "failed":
                reasons[line["test"]] = line["why"]
    return outcomes, reasons
