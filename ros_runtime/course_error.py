"""The base of errors that a person can mend: `course` prints them and ends with their exit status."""

from __future__ import annotations

COULD_NOT, UNUSABLE = 1, 2  # exit statuses: it could not do its job; what it was given cannot be used


class CourseError(Exception):
    """What was seen, expected and to do next, in a sentence or two; without a traceback."""

    exit_status = UNUSABLE
