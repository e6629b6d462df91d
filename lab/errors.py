"""What can go wrong in a notebook, each with what was seen, what was expected and what to do next."""

from __future__ import annotations


class LabError(Exception):
    """Something in the lab did not happen."""

    def _render_traceback_(self) -> list[str]:
        """Jupyter shows this instead of a traceback: the lines of the lab teach nobody anything."""
        return [f"{type(self).__name__}: {self}"]


class NoRobotError(LabError):
    """The robot does not run, or says nothing."""


class NoServerError(LabError):
    """Nobody offers the service or action."""


class NoAnswerError(LabError):
    """The server took longer than the caller wanted to wait, or is no longer there."""


class NodeEndedError(LabError):
    """A student's file ended with an error before it was a node."""


class NotInTimeError(LabError):
    """A condition did not come true."""
