"""The errors of the lab; each message says what went wrong and what to do next."""

from __future__ import annotations


class LabError(Exception):
    """Base class of the lab's errors; raised itself when a function of the lab is used wrongly."""

    def _render_traceback_(self) -> list[str]:
        """Return the one line that Jupyter shows instead of a traceback through the lab's own code."""
        return [f"{type(self).__name__}: {self}"]


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
