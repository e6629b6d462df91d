"""Ctrl-C ends a student's node as in a terminal, also if a script has started the grader.

A program that a script starts in the background (`course grade … &`) ignores SIGINT, and its children inherit that.
"""

from __future__ import annotations

import signal
from collections.abc import Iterator

import pytest

from autograder.engine.arena_run import ArenaRun, run_in_arena
from autograder.engine.exercise import load_exercise
from autograder.engine.submission_arenas import SubmissionArenas

SAYS_WHAT_CTRL_C_DOES = b"import signal\nprint(signal.getsignal(signal.SIGINT).__name__)\n"


@pytest.fixture
def interrupts_are_ignored() -> Iterator[None]:
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.usefixtures("interrupts_are_ignored")
def test_a_node_starts_with_ctrl_c_as_in_a_terminal() -> None:
    exercise = load_exercise("battery_service", hidden=True)
    files = {"battery_service.py": SAYS_WHAT_CTRL_C_DOES}
    with SubmissionArenas(exercise.scenario_file) as arenas:
        run = ArenaRun(exercise, files, exercise.checks[0].on[0])
        assert run_in_arena(run, arenas=arenas).output("stdout") == "default_int_handler"
