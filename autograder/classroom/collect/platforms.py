"""Every platform whose downloads can be read, by its name."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from autograder.classroom.collect import canvas, classroom50, gradescope, moodle
from autograder.classroom.collect.download import Download
from autograder.classroom.collect.handed_in import Assignment, Reading


@dataclass(frozen=True)
class Platform:
    """How a platform's download is read, and what it looks like in a sentence."""

    read: Callable[[Download, Assignment], Reading]
    expected: str


PLATFORMS: Mapping[str, Platform] = {
    "canvas": Platform(canvas.read, canvas.EXPECTED),
    "moodle": Platform(moodle.read, moodle.EXPECTED),
    "gradescope": Platform(gradescope.read, gradescope.EXPECTED),
    "classroom50": Platform(classroom50.read, classroom50.EXPECTED),
}
