"""Canvas' “Download Submissions”: name_[LATE_]USER_ATTACHMENT_file, all in one folder.

Format: lib/content_zipper.rb of https://github.com/instructure/canvas-lms. Where an assignment is anonymous the name is
left out and five letters or digits stand for the user: [LATE_]anon_USER_ATTACHMENT_file.

A file that replaces one of the same name is called file-1, file-2 …; the attachment's number says which is the last.
The student's folder ends with Canvas' number of the user, by which `course export` finds their row.
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
