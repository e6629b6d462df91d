"""Goes from seed to seed for so many minutes: in each round all readers, then one made-up program in an arena.

Each part of a round is a process of its own, so that a crash, a hang or a memory that fills up is a finding, too.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from fuzz.__main__ import BEGINS, FOUND
from fuzz.finding import Finding
from ros_runtime.project import PROJECT

SHOWN = 4000  # characters of what a process said before it crashed
PROCESS = (sys.executable, "-m", "fuzz")
Tell = Callable[[str], None]


@dataclass(frozen=True)
class Rounds:
    """What was done: how many rounds, and the files with what was found."""

    count: int
    found: Sequence[Path]


def run_rounds(
    minutes: float, seed: int, readers: Sequence[str], targets: Sequence[str], *, tell: Tell
) -> Rounds:
    """Fuzz until the minutes are over, at least one round.

    Args:
        minutes: how long.
        seed: of the first round; each round has the next one.
        readers: the names of the readers' fuzzers, of which all are in each round.
        targets: the names of those in arenas, of which each round has one.
        tell: gets a line for each round.
    """
    until, started = time.time() + minutes * 60, time.monotonic()
    found: list[Path] = []
    count = 0
    while not count or time.time() < until:
        parts = [list(readers)] if readers else []
        parts += [[targets[seed % len(targets)]]] if targets else []
        for part in parts:
            for path in run_part(seed, part, until):
                found.append(path)
                tell(f"FOUND {path}")
        count += 1
        tell(f"seed {seed}: {count} rounds in {time.monotonic() - started:.0f} s, {len(found)} found")
        seed += 1
    return Rounds(count, found)


def run_part(seed: int, names: Sequence[str], until: float) -> Iterator[Path]:
    """Run fuzzers in a process, and yield the files with what they found; after a crash go on with the next one."""
    left = list(names)
    while left:
        with tempfile.TemporaryFile("w+", errors="backslashreplace") as said:
            command = [*PROCESS, str(seed), str(until), *left]
            process = subprocess.Popen(command, cwd=PROJECT, stdout=subprocess.PIPE, stderr=said, text=True)
            latest, news = left[0], 0
            assert process.stdout
            with process.stdout:
                for line in process.stdout:
                    if line.startswith(BEGINS):
                        latest = line.removeprefix(BEGINS).strip()
                    elif line.startswith(FOUND):
                        news += 1
                        yield Path(line.removeprefix(FOUND).strip())
            status = process.wait()
            if status == 0 or (status == 1 and news):
                return
            said.seek(0)
            problem = f"the process ended with status {status}:\n{said.read()[-SHOWN:]}"
        yield Finding(latest, seed, problem, "the process did not get as far as to say").keep()
        left = left[left.index(latest) + 1 :]
