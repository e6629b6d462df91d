"""The line with the check whose scenario runs: on a terminal, in a notebook, and in plain output."""

from __future__ import annotations

import io
from types import SimpleNamespace

from rich.console import Console

from autograder.authoring.checks import Check, Scenario
from autograder.report.running import RunningLine

ASK, WALK = Scenario("ask_once"), Scenario("walk")
AGAIN = Scenario("ask_once", namespace="/lab_7/robot")
CHECKS = [
    Check("It answers", 1, lambda run: None, on=(ASK, AGAIN)),
    Check("It walks", 1, lambda run: None, on=(WALK, ASK)),
]


def plain():
    return Console(file=io.StringIO(), width=100)


def test_a_plain_output_gets_a_line_at_each_change():
    console = plain()
    with RunningLine(console, CHECKS) as line:
        for scenarios in ([ASK], [ASK], [ASK, WALK], [WALK], []):
            line.show(scenarios)
    lines = console.file.getvalue().splitlines()
    assert lines == ["checking: It answers", "checking: It answers; It walks", "checking: It walks"]


def test_a_check_of_two_running_scenarios_is_named_once():
    console = plain()
    with RunningLine(console, CHECKS) as line:
        line.show([ASK, AGAIN])
    assert console.file.getvalue() == "checking: It answers\n"


def test_on_a_terminal_the_line_is_gone_at_the_end_and_verdicts_stand_above_it():
    console = Console(file=io.StringIO(), width=100, force_terminal=True)
    with RunningLine(console, CHECKS) as line:
        line.show([ASK])
        console.print("a verdict")
    written = console.file.getvalue()
    assert "checking: It answers" in written
    assert "a verdict\n" in written
    assert written.rstrip("\x1b[?25h").endswith("\x1b[2K")  # the line is erased, the cursor shown again


def test_in_a_notebook_the_line_is_its_notice():
    shown = []
    with RunningLine(plain(), CHECKS, SimpleNamespace(show=shown.append)) as line:
        line.show([ASK, WALK])
        line.show([WALK])
    assert shown == ["checking: It answers; It walks", "checking: It walks", ""]
