"""Reads Classroom 50's `gh teacher download`: a clone for each student, <classroom>-<assignment>-<user>/.

Format: cli/gh-teacher/internal/download/download.go of https://github.com/foundation50/classroom50. The command also
writes scores.csv beside the folders, and result.json and results.json into them. Each part of a folder's name may
contain hyphens. The assignment in the middle is found because it is the exercise's name, or the --assignment given.
"""

from __future__ import annotations

import re

from autograder.classroom.collect.download import Download
from autograder.classroom.collect.handed_in import Assignment, Reading, without_wrapper
from autograder.engine.exercise import all_names

EXPECTED = "folders such as robotics-battery-service-anna"


def read(download: Download, assignment: Assignment) -> Reading:
    """Return every student's files."""
    reading = Reading()
    exercises = _by_slug(assignment)
    slugs = "|".join(sorted(map(re.escape, exercises), key=len, reverse=True))
    folder = re.compile(rf"(?P<classroom>.+?)-(?P<slug>{slugs})-(?P<user>[^/]+)", re.IGNORECASE)
    unknown_names: set[str] = set()
    for file, parts in without_wrapper(download, folder):
        match = folder.fullmatch(parts[0])
        if not match or len(parts) == 1:
            unknown_names.add(parts[0])
            continue
        reading.add(file, parts[-1], match["user"], exercise=exercises[match["slug"].lower()])
    known = ", ".join(sorted(exercises))
    reading.unknown = [
        f"{name} is not named <classroom>-<assignment>-<user> with an assignment of {known}"
        for name in sorted(unknown_names)
    ]
    return reading


def _by_slug(assignment: Assignment) -> dict[str, str]:
    """Return the exercises by the name that their assignment has in a folder's name."""
    if assignment.slug:
        return {assignment.slug.lower(): assignment.exercise}
    names = [assignment.exercise] if assignment.exercise else all_names()
    return {slug: name for name in names for slug in (name.lower(), name.lower().replace("_", "-"))}
