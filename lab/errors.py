"""The errors of the lab; each message says what went wrong and what to do next."""

from __future__ import annotations

from ros_runtime.course_error import CourseError


class LabError(CourseError):
    """Base class of the lab's errors; raised itself when a function of the lab is used wrongly."""


class NoRobotError(LabError):
    """The robot does not run, or publishes no messages."""


class NoServerError(LabError):
    """No node offers the service or action."""


class NoAnswerError(LabError):
    """The server did not respond in time, or has ended."""


class NodeEndedError(LabError):
    """The student's file ended with an error before its node had started."""


class NotInTimeError(LabError):
    """A condition did not become true in time."""
