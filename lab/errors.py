"""The errors of the lab; each message says what was seen, what was expected and what to do next."""

from __future__ import annotations


class LabError(Exception):
    """Base class: a request of a notebook failed."""

    def _render_traceback_(self) -> list[str]:
        """Jupyter shows this line instead of a traceback, which would only list lines of the lab."""
        return [f"{type(self).__name__}: {self}"]


class NoRobotError(LabError):
    """The robot does not run, or publishes nothing."""


class NoServerError(LabError):
    """No node offers the service or action."""


class NoAnswerError(LabError):
    """The server did not answer in time, or is gone."""


class NodeEndedError(LabError):
    """Your file ended with an error before its node had started."""


class NotInTimeError(LabError):
    """A condition did not become true in time."""
