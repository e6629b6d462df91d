"""`course test --fuzz`: it says its seeds, goes on after a crash, and ends with what was found."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from autograder.classroom.commands import test as command
from fuzz import finding, rounds

SOUND = "import sys; [print('begins', name) for name in sys.argv[3:]]"
CRASHES = """
import os, sys
for name in sys.argv[3:]:
    print("begins", name, flush=True)
    if name == "second":
        print("it broke", file=sys.stderr, flush=True)
        os.abort()
"""


@pytest.fixture(autouse=True)
def kept(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Path:
    """Keep what is found in the folder of the test."""
    keep = finding.Finding.keep
    monkeypatch.setattr(finding.Finding, "keep", lambda self: keep(self, tmp_path))
    return tmp_path


def replace_process(monkeypatch: pytest.MonkeyPatch, program: str) -> None:
    monkeypatch.setattr(rounds, "PROCESS", (sys.executable, "-c", program))


def test_a_round_tells_its_seed(monkeypatch: pytest.MonkeyPatch) -> None:
    replace_process(monkeypatch, SOUND)
    told: list[str] = []
    done = rounds.run_rounds(0, 5, ["first"], ["arena"], tell=told.append)
    assert (done.count, list(done.found)) == (1, [])
    assert told[-1].startswith("seed 5: 1 rounds in")


def test_a_process_that_crashes_is_a_finding_with_what_it_said_and_the_others_go_on(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    replace_process(monkeypatch, CRASHES)
    begun = [path.name for path in rounds.run_part(7, ["first", "second", "third"], 0.0)]
    assert begun == ["second-7.txt"]


def test_the_command_fails_and_shows_what_was_found(
    monkeypatch: pytest.MonkeyPatch, kept: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    replace_process(monkeypatch, CRASHES.replace("second", "graph"))
    assert not command.run_fuzzers(0, 9, ["graph"])
    said = capsys.readouterr().out
    assert "it broke" in said
    assert "./course test --fuzz 0 --fuzz-only graph --fuzz-seed 9" in said
    assert (kept / "graph-9.txt").exists()
