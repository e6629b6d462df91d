"""The part of a recording that is shown."""

from __future__ import annotations

from dataclasses import dataclass

from autograder.recording.replay.recording import NoRecording, Recording

AROUND = 6.0  # s shown around a check
BEFORE = 2 / 3  # of these seconds are before the verdict


@dataclass(frozen=True)
class Span:
    """From `start` to `end`, s on the arena's clock."""

    start: float
    end: float


def span_of(recording: Recording, around: str | None, seconds: float | None) -> Span:
    """Return what to show: the seconds around a check, by default around the first that failed, else all.

    Args:
        recording: of which.
        around: id of a check.
        seconds: how long; without a check, from the beginning.

    Raises:
        NoRecording: there is no such check.
        ValueError: the duration is not positive.
    """
    if seconds is not None and not seconds > 0:
        raise ValueError(f"--seconds is {seconds:g}; expected a positive number")
    verdict = recording.verdict(around) if around else recording.first_failed
    if verdict is None:
        return Span(0.0, min(recording.end, seconds or recording.end))
    length = min(seconds or AROUND, recording.end)
    start = min(max(0.0, verdict.t - BEFORE * length), recording.end - length)
    return Span(start, start + length)


def require_postures(recording: Recording) -> None:
    """Require recorded postures of a robot."""
    if not recording.postures:
        raise NoRecording(
            f"no robot was recorded in {recording.about['scenario']}, as the scenario has none; --text shows what "
            "happened"
        )
