"""The base class of errors that the user can fix: `course` prints them and exits with their status."""

from __future__ import annotations

COMMAND_FAILED = 1  # exit status: the command failed
UNUSABLE = 2  # exit status: the command's arguments or files are unusable
NOT_GRADED = 3  # exit status: the grader could not judge a submission


class CourseError(Exception):
    """The message says what was seen, what was expected and what to do next; `course` and Jupyter show no traceback.

    Docstrings name only those of its classes that somebody catches on the way.
    """

    exit_status = UNUSABLE

    def _render_traceback_(self) -> list[str]:
        """Jupyter shows this instead of a traceback."""
        return [f"{type(self).__name__}: {self}"]


class CommandFailed(CourseError):
    """The arguments are usable, but the command could not do its job."""

    exit_status = COMMAND_FAILED
