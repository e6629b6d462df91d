"""Reads Moodle's “Download all submissions”: Name_NUMBER_assignsubmission_file/file, or without the folder.

Format: mod/assign/classes/downloader.php of https://github.com/moodle/moodle. Before Moodle 4.1 the folder's name ended
with one more underscore. The number identifies the participant in this assignment and is the same in its grading
worksheet. In an anonymous assignment every name is the word “Participant”, in the site's language. If groups hand in,
name and number are the group's, and students without a group have no number.
"""

from __future__ import annotations

import re

from autograder.classroom.collect.download import Download
from autograder.classroom.collect.handed_in import Assignment, Reading, without_wrapper

EXPECTED = "folders such as Anna Lee_12345_assignsubmission_file, or files whose names begin like this"
_MARK = "_assignsubmission_file"
_NAME = re.compile(rf"(?P<name>.+?)(?:_(?P<user>\d+))?{_MARK}(?:_(?P<file>.*))?")


def read(download: Download, assignment: Assignment) -> Reading:
    """Return every student's files."""
    reading = Reading()
    for file, parts in without_wrapper(download, _NAME):
        match = _NAME.fullmatch(parts[0])
        name = match and (match["file"] if len(parts) == 1 else parts[-1])
        if not match or not name:
            reading.unknown.append(f"{file.path} does not have the name of a Moodle submission")
            continue
        if parts[0].count(_MARK) > 1:
            reading.refused.append(f"{file.path} names two students, so its author is unclear")
            continue
        reading.add(file, name, match["name"], match["user"] or "")
    return reading
