"""Reads Gradescope's “Export Submissions”: folders submission_NUMBER, and submission_metadata.yml with their students.

Format: https://help.gradescope.com, “Export submissions”. The metadata is YAML as Ruby writes it, the same in every
language of the site. A student's folder has the name of their student id, else of their e-mail address, else their
name. The work of a group is collected for each of its students.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from datetime import date, datetime, timezone
from typing import Any

import yaml

from autograder.classroom.collect.download import Download, Refused
from autograder.classroom.collect.handed_in import Assignment, Reading, without_wrapper
from ros_runtime.course_error import CourseError

EXPECTED = "submission_metadata.yml, and folders such as submission_12345 beside it"
METADATA = "submission_metadata.yml"
MAX_METADATA_BYTES = 100_000_000  # the metadata contains every test of every submission
_FOLDER = re.compile(r"submission_(?P<number>\d{1,18})")


class _Loader(yaml.CSafeLoader if hasattr(yaml, "CSafeLoader") else yaml.SafeLoader):  # type: ignore[misc]
    """Reads plain data only; objects of Ruby's own types become mappings or None."""


def _plain(loader: yaml.SafeLoader, tag: str, node: yaml.Node) -> Any:
    return loader.construct_mapping(node, deep=True) if isinstance(node, yaml.MappingNode) else None


_Loader.add_multi_constructor("!ruby/", _plain)


def read(download: Download, assignment: Assignment) -> Reading:
    """Return every student's files; raises `CourseError` without usable metadata."""
    reading = Reading()
    submissions = _metadata(download)
    for file, parts in without_wrapper(download, _FOLDER):
        if parts == (METADATA,):
            continue
        found = _FOLDER.fullmatch(parts[0])
        about = submissions.get(parts[0])
        if not found or len(parts) == 1 or not isinstance(about, Mapping):
            reading.unknown.append(f"{file.path} belongs to no submission in {METADATA}")
            continue
        submitters = about.get(":submitters") or [{}]
        for name in map(_name_of, submitters):
            if name:
                turn, when = int(found["number"]), _timestamp(about.get(":created_at"))
                reading.add(file, file.path.name, name, turn=turn, timestamp=when)
            else:
                reading.refused.append(f"{file.path}: {METADATA} does not name the student")
    return reading


def _metadata(download: Download) -> Mapping[str, Any]:
    places = [file for file, parts in without_wrapper(download, _FOLDER) if parts == (METADATA,)]
    if not places:
        raise CourseError(f"there is no {METADATA}; expected Gradescope's export of submissions: {EXPECTED}")
    try:
        read = yaml.load(places[0].read(MAX_METADATA_BYTES), Loader=_Loader)
    except (yaml.YAMLError, Refused, ValueError, RecursionError) as error:
        raise CourseError(f"{places[0].path} cannot be read: {error}") from error
    if not isinstance(read, Mapping):
        raise CourseError(f"{places[0].path} is not a list of submissions; expected {EXPECTED}")
    return read


def _name_of(submitter: Any) -> str:
    known = submitter if isinstance(submitter, Mapping) else {}
    for key in (":sid", ":email", ":name"):
        if known.get(key):
            return str(known[key])
    return ""


def _timestamp(created: Any) -> str:
    if isinstance(created, str):
        try:
            created = datetime.fromisoformat(created)
        except ValueError:
            return ""
    if not isinstance(created, datetime):
        return str(created) if isinstance(created, date) else ""
    in_utc = created.astimezone(timezone.utc) if created.tzinfo else created
    return f"{in_utc:%Y-%m-%d %H:%M:%S} UTC"
