"""A hash of everything that a verdict depends on, except the submission."""

from __future__ import annotations

import hashlib
import subprocess
from functools import lru_cache
from pathlib import Path

from ros_runtime.project import PROJECT

# Folders whose files can change a verdict: the engine, the robot, the clock and the interfaces.
JUDGING_FOLDERS = ("autograder", "robot_sim", "ros_runtime", "humanoid_interfaces")
WITHOUT_INFLUENCE = ("autograder/classroom", "autograder/recording", "autograder/report")
HIDDEN_CHECKS = "autograder/classroom/hidden_checks"  # the only part of classroom/ that has influence


@lru_cache
def checks_version(exercise: Path) -> str:
    """Return a hash of every file that a verdict on the exercise in this folder depends on."""
    digest = hashlib.sha256()
    for path in sorted(exercise.glob("*.py")):
        digest.update(f"{path.name}\0".encode() + path.read_bytes())
    for folder in JUDGING_FOLDERS:
        for path in sorted((PROJECT / folder).rglob("*")):
            place = path.relative_to(PROJECT)
            if path.is_file() and "__pycache__" not in place.parts and _has_influence(place):
                digest.update(f"{place}\0".encode() + path.read_bytes())
    return digest.hexdigest()


def _has_influence(place: Path) -> bool:
    return place.is_relative_to(HIDDEN_CHECKS) or not any(map(place.is_relative_to, WITHOUT_INFLUENCE))


def commit_of(folder: Path) -> str:
    """Return the commit of a folder's git repository, with a note on uncommitted changes; "" if there is none."""
    commit = _git(folder, "rev-parse", "HEAD")
    if commit and _git(folder, "status", "--porcelain", "--untracked-files=no", "--", "."):
        return f"{commit} with changes that are not committed"
    return commit


def _git(folder: Path, *arguments: str) -> str:
    try:
        ran = subprocess.run(
            ["git", "-C", str(folder), *arguments], capture_output=True, text=True, check=False, timeout=30
        )
    except (OSError, subprocess.TimeoutExpired):
        return ""
    return ran.stdout.strip() if ran.returncode == 0 else ""
