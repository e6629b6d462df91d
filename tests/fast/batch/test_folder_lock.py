"""Two graders cannot write to the same folder."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

from autograder.classroom.batch.folder_lock import locked
from ros_runtime.course_error import CommandFailed

HOLD = "import sys; from pathlib import Path; from autograder.classroom.batch.folder_lock import locked\n"
HOLD += "with locked(Path(sys.argv[1])): print('held', flush=True); sys.stdin.read()"


def test_the_second_is_refused_with_the_process_of_the_first(tmp_path):
    with locked(tmp_path / "graded"):
        refused = pytest.raises(CommandFailed, match=rf"process {os.getpid()} on .*another --out")
        with refused, locked(tmp_path / "graded"):
            pass
        with locked(tmp_path / "another"):
            pass
    with locked(tmp_path / "graded"):
        pass


def test_a_killed_process_leaves_the_folder_free(tmp_path):
    with subprocess.Popen(
        [sys.executable, "-c", HOLD, tmp_path], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    ) as holder:
        assert holder.stdout
        assert holder.stdout.readline() == b"held\n"
        with pytest.raises(CommandFailed, match=str(holder.pid)), locked(tmp_path):
            pass
        holder.kill()
    with locked(tmp_path):
        pass
