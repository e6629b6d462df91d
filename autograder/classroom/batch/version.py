"""What a verdict depends on besides the submission, as a hash."""

from __future__ import annotations

import hashlib
from functools import lru_cache
from pathlib import Path

from ros_runtime.project import PROJECT

# The checks and the engine, the robot, the clock.
JUDGING = ("autograder", "robot_sim", "ros_runtime", "humanoid_interfaces")
WITHOUT_INFLUENCE = (
    "batch",
    "nbgrader_bridge",
    "recording",
    "report",
    "audit",
    "new_exercise",
)  # folders of autograder/


@lru_cache
def checks_version(exercise: Path) -> str:
    """Return a hash of every file that a verdict on the exercise in this folder depends on."""
    digest = hashlib.sha256()
    for path in sorted(exercise.glob("*.py")):
        digest.update(f"{path.name}\0".encode() + path.read_bytes())
    for room in JUDGING:
        for path in sorted((PROJECT / room).rglob("*")):
            place = path.relative_to(PROJECT)
            if path.is_file() and "__pycache__" not in place.parts and _has_influence(place):
                digest.update(f"{place}\0".encode() + path.read_bytes())
    return digest.hexdigest()


def _has_influence(place: Path) -> bool:
    return not (place.parts[0] == "autograder" and place.parts[1] in WITHOUT_INFLUENCE)
