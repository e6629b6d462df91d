"""`course bench --checks-of`: what each check costs, measured on the reference."""

import subprocess
import sys
from pathlib import Path

from autograder.engine.exercise import load_exercise

COURSE = Path(sys.executable).with_name("course")


def bench(*options):
    return subprocess.run([COURSE, "bench", *options], capture_output=True, text=True, check=False)


def test_each_check_is_listed_with_its_arenas_and_the_last_row_counts_every_arena_once():
    ran = bench("--checks-of", "patterns")
    assert ran.returncode == 0, ran.stdout + ran.stderr
    rows = {
        cells[0]: cells[1:]
        for line in ran.stdout.splitlines()
        if line.startswith("│")
        for cells in [[cell.strip() for cell in line.strip("│").split("│")]]
    }
    checks = load_exercise("patterns", hidden=False).checks
    assert {check.id for check in checks} < set(rows)
    assert rows["situation_1"][:2] == ["1", "1"]
    _, arenas, _, wall = rows["all"]
    assert (arenas, wall) == ("1", rows["situation_1"][3])


def test_an_unknown_exercise_is_an_unusable_argument():
    ran = bench("--checks-of", "patternz")
    assert ran.returncode == 2
    assert "there is no exercise 'patternz'" in " ".join(ran.stdout.split())
    assert "Traceback" not in ran.stderr
