"""Recorded transcripts of real arenas in `transcripts/`, for tests of checks without arenas.

One file is one run of one scenario: a line with the scenario's inputs and the clock's scale, then one line per event,
in order of time.
"""

from __future__ import annotations

import gzip
import json
from dataclasses import dataclass
from pathlib import Path

from autograder.authoring.checks import Check, Scenario
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.engine.exercise import load_exercise
from ros_runtime.project import PROJECT
from ros_runtime.record.event import to_line

FOLDER = PROJECT / "tests/arena/autograder/transcripts"


@dataclass(frozen=True, eq=False)
class Case:
    """A check and the recorded transcripts it judges."""

    submission: str
    check: Check
    transcripts: tuple[Transcript, ...]

    def __str__(self) -> str:
        return f"{self.submission}: {self.check.id}"


def scenarios_of(exercise: str) -> dict[str, Scenario]:
    """Return the scenarios of an exercise by name; the second and later ones of a name get a number, as in walk-2."""
    named: dict[str, Scenario] = {}
    for check in load_exercise(exercise, hidden=True).checks:
        for scenario in check.on:
            if scenario not in named.values():
                alike = sum(name.split("-")[0] == scenario.name for name in named)
                named[f"{scenario.name}-{alike + 1}" if alike else scenario.name] = scenario
    return named


def write(path: Path, transcript: Transcript) -> None:
    """Write a transcript to a file."""
    events = sorted([*transcript.events, *transcript.ground_truth], key=lambda event: event.t)
    head = {"params": transcript.params, "scale": transcript.scale}
    lines = [json.dumps(head).encode(), *(to_line(event).rstrip() for event in events)]
    path.parent.mkdir(parents=True, exist_ok=True)
    # tracebacks name the machine's own path
    kept = b"\n".join(lines).replace(str(PROJECT).encode(), b"/course")
    path.write_bytes(gzip.compress(kept, mtime=0))


def read(path: Path, scenario: Scenario) -> Transcript:
    """Read a transcript; fails if the scenario's inputs have changed since the recording."""
    head, *lines = gzip.decompress(path.read_bytes()).decode().splitlines()
    kept = json.loads(head)
    now = json.dumps(scenario.draw(0))
    assert now == json.dumps(kept["params"]), f"{path.name} has other inputs: record it again"
    return Transcript.from_events(
        scenario.name, scenario.draw(0), [ev.parse_event(line) for line in lines], kept["scale"]
    )


def cases(exercise: str) -> list[Case]:
    """Return each check of an exercise with a submission's transcripts, for each submission that has all of them."""
    scenarios = scenarios_of(exercise)
    kept: dict[str, dict[Scenario, Transcript]] = {}
    for path in sorted((FOLDER / exercise).glob("*.jsonl.gz")):
        submission, name = path.name.removesuffix(".jsonl.gz").split(".")
        kept.setdefault(submission, {})[scenarios[name]] = read(path, scenarios[name])
    return [
        Case(submission, check, tuple(runs[scenario] for scenario in check.on))
        for submission, runs in kept.items()
        for check in load_exercise(exercise, hidden=True).checks
        if all(scenario in runs for scenario in check.on)
    ]
