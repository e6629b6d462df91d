"""Ctrl-C while scenarios run: the batch ends soon, prints how to resume, and leaves nothing behind."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import psutil
import pytest

from autograder.isolation.availability import available_isolation
from leftovers import leftovers

FILE = "walk_client.py"
AT_MOST = 10.0  # s on a busy machine, of which an arena that has just begun would last 20 and more
# Its node never appears, so that its scenario waits for as long as this test needs.
SILENT = "import time\ntime.sleep(600)\n"
COMMAND = (Path(sys.executable).with_name("course"), "grade", "submitted", "--out", "graded", "--jobs", "2")


def running(grader: psutil.Process) -> int:
    """The number of students' programs that run."""
    found = 0
    for process in grader.children(recursive=True):
        try:
            found += process.cmdline()[1:2] == [FILE]
        except psutil.Error:  # the process has just ended
            continue
    return found


@pytest.mark.skipif(not available_isolation().trusted, reason="hidden checks need isolated arenas")
def test_ctrl_c_ends_the_scenarios_that_run_and_leaves_nothing(tmp_path: Path) -> None:
    for student in ("anna", "bert"):
        (tmp_path / "submitted" / student).mkdir(parents=True)
        (tmp_path / "submitted" / student / FILE).write_text(SILENT)
    with leftovers() as left:
        grader = subprocess.Popen(
            COMMAND,
            cwd=tmp_path,
            env={**os.environ, "COLUMNS": "200"},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        with grader:
            while grader.poll() is None and running(psutil.Process(grader.pid)) < 2:
                time.sleep(0.05)  # between two polls
            grader.send_signal(signal.SIGINT)
            asked = time.monotonic()
            said, _ = grader.communicate(timeout=60)
            took = time.monotonic() - asked
    assert grader.returncode == 1, said
    assert "Interrupted. Add --resume" in said
    assert "Traceback" not in said
    assert left == []
    assert not list(Path(tempfile.gettempdir()).glob(f"arena-{grader.pid}-*"))
    assert took < AT_MOST, f"it took {took:.1f} s to end after Ctrl-C; 2 s are promised for an idle machine"
