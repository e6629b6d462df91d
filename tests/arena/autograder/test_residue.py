"""Hostile submissions leave nothing on the machine and do not change the next submission's grade."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from dataclasses import replace
from pathlib import Path

import pytest

from autograder.classroom.audit.known_submission import KnownSubmission, known_submission
from autograder.classroom.audit.run import audit_one
from autograder.engine.exercise import Exercise, load_exercise
from autograder.isolation.availability import available_isolation
from leftovers import leftovers
from ros_runtime.ros_domain import ReservedDomain

EXERCISE = "battery_service"
# Of each kind of exercise: a node, a client, files that are built, a quiz.
HOSTILE = (
    (EXERCISE, "fork_bomb"),
    (EXERCISE, "outlives_its_parent"),
    (EXERCISE, "wakes_all_at_once"),
    ("walk_client", "floods_goals"),
    ("interfaces", "thousands_of_errors"),
    ("patterns", "every_answer"),
)
AT_FIRST = (
    "server_appears",
    "answers_with_the_last_message",
)  # checks that show whether the next submission is unaffected


def caught_only(known: KnownSubmission) -> Exercise:
    """The exercise with only the checks that must catch the submission, and those they need."""
    exercise = load_exercise(known.exercise, hidden=True)
    needed = {need.id for check in exercise.checks if check.id in known.caught_by for need in check.needs}
    wanted = {*known.caught_by, *needed}
    return replace(exercise, checks=[check for check in exercise.checks if check.id in wanted])


@pytest.mark.skipif(not available_isolation().trusted, reason="hidden checks need isolated arenas")
def test_hostile_submissions_leave_nothing_and_change_no_other_grade() -> None:
    exercise = load_exercise(EXERCISE, hidden=True)
    few = replace(exercise, checks=[check for check in exercise.checks if check.id in AT_FIRST])
    honest = known_submission(EXERCISE, "correct/class_based")
    for its_exercise, name in HOSTILE:
        known = known_submission(its_exercise, f"hostile/{name}")
        with leftovers() as left:
            audited = audit_one(known, caught_only(known), checks_without_retry=known.caught_by)
        assert audited.surprises() == [], name
        assert left == [], name
    assert audit_one(honest, few).grade.all_passed


def test_each_kind_of_residue_is_seen() -> None:
    with leftovers(timeout=0.2) as left:
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


def test_an_orphan_process_is_detected() -> None:
    orphan = "import os, time\nif os.fork() == 0:\n    os.setsid(); time.sleep(60)"
    with leftovers(timeout=0.2) as left:
        subprocess.run([sys.executable, "-c", orphan], check=True)
    (line,) = left
    pid = int(line.split()[1].rstrip(","))
    os.kill(pid, 9)
    os.waitpid(pid, 0)
