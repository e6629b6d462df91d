"""Reads Canvas' “Download Submissions”, one folder of files called name_[LATE_]USER_ATTACHMENT_file.

Format: lib/content_zipper.rb of https://github.com/instructure/canvas-lms. In an anonymous assignment the files are
called [LATE_]anon_USER_ATTACHMENT_file, and USER has five letters or digits.

Canvas adds -1, -2 … to the name of a file that replaces an earlier one; the file with the highest attachment number is
the latest. The student's folder ends with Canvas' number of the user, by which `course export` finds the user's row.
"""

from __future__ import annotations

import re

from autograder.classroom.collect.download import Download
from autograder.classroom.collect.handed_in import Assignment, Reading, without_wrapper

EXPECTED = "files such as leeanna_12345_678_battery_service.ipynb"
_NAME = re.compile(
    r"(?:(?P<late_anonymous>LATE_)?(?P<anonymous>anon_[A-Za-z0-9]{5})|(?P<name>.*?)_(?P<late>LATE_)?(?P<user>\d+))"
    r"_(?P<attachment>\d{1,18})_(?P<file>.+)"
)


def read(download: Download, assignment: Assignment) -> Reading:
    """Return every student's files."""
    reading = Reading()
    for file, parts in without_wrapper(download, _NAME):
        match = _NAME.fullmatch(parts[0])
        if not match or len(parts) > 1:
            reading.unknown.append(f"{file.path} does not have the name of a Canvas submission")
            continue
        late = bool(match["late"] or match["late_anonymous"])
        student = match["anonymous"] or match["name"], match["user"] or ""
        reading.add(file, match["file"], *student, turn=int(match["attachment"]), late=late)
    return reading
