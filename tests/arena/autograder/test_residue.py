"""After hostile submissions nothing is left on the machine, and the next submission's grade is as without them."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from dataclasses import replace
from pathlib import Path

import pytest

from autograder.audit.known_submission import known_submission
from autograder.audit.proof import enough_to_catch
from autograder.audit.residue import residue
from autograder.audit.run import audit_one
from autograder.engine.exercise import load_exercise
from autograder.isolation.availability import available_isolation
from ros_runtime.ros_domain import ReservedDomain

EXERCISE = "battery_service"
# Processes, files, sockets, the processors, the kernel's answers.
HOSTILE = ("fork_bomb", "outlives_its_parent", "makes_empty_files", "hoards_sockets", "wakes_all_at_once")
AT_FIRST = (
    "server_appears",
    "answers_with_the_last_message",
)  # checks that tell whether the next one is unharmed


@pytest.mark.skipif(not available_isolation().trusted, reason="hidden checks need isolated arenas")
def test_hostile_submissions_leave_nothing_and_change_no_other_grade() -> None:
    exercise = load_exercise(EXERCISE, hidden=True)
    few = replace(exercise, checks=[check for check in exercise.checks if check.id in AT_FIRST])
    honest = known_submission(EXERCISE, "correct/class_based")
    for name in HOSTILE:
        known = known_submission(EXERCISE, f"hostile/{name}")
        with residue() as left:
            audited = audit_one(known, enough_to_catch(known, exercise), at_first_look=known.caught_by)
        assert audited.surprises() == [], name
        assert left == [], name
    assert audit_one(honest, few).grade.all_passed


def test_each_kind_of_residue_is_seen() -> None:
    with residue(patience=0.2) as left:
        kept = [subprocess.Popen([sys.executable, "-c", "input()"], stdin=subprocess.PIPE)]
        folder = Path(tempfile.mkdtemp(prefix=f"arena-{os.getpid()}-", dir="/tmp"))
        domain = ReservedDomain()
    try:
        kinds = sorted(line.split()[0] for line in left)
        assert kinds == ["file", "lock", "process"], left
    finally:
        folder.rmdir()
        domain.release()
        for process in kept:
            process.communicate()


def test_an_orphan_is_seen() -> None:
    orphan = "import os, time\nif os.fork() == 0:\n    os.setsid(); time.sleep(60)"
    with residue(patience=0.2) as left:
        subprocess.run([sys.executable, "-c", orphan], check=True)
    (line,) = left
    pid = int(line.split()[1].rstrip(","))
    os.kill(pid, 9)
    os.waitpid(pid, 0)
