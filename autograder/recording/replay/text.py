"""Prints the events of a recording as lines for the terminal."""

from __future__ import annotations

from collections.abc import Iterator

from rich.text import Text

from autograder.recording.replay.recording import Kind, Moment, Recording
from autograder.report.console import BAD, GOOD, NOTICE, OTHER

COLOURS = {
    Kind.EVENT: "",
    Kind.FEEDBACK: "dim",
    Kind.OUTPUT: OTHER,
    Kind.PASSED: GOOD,
    Kind.FAILED: BAD,
    Kind.WARNING: NOTICE,
}


def title(recording: Recording) -> str:
    """Return a line with exercise, student, scenario, seed, duration and clock scale of a recording."""
    about = recording.about
    seed = f", seed {about['seed']}" if about["seed"] not in ("", "None") else ""
    return (
        f"{about['exercise']} · {about['student']} · scenario {about['scenario']}{seed}: {recording.end:.1f} s on the "
        f"arena's clock, which ran {about['scale']} times as fast as real time"
    )


def line(moment: Moment) -> Text:
    """Return a moment as a line, with its time and text."""
    return Text.assemble((f"{moment.t:8.2f} s  ", "dim"), (moment.text, COLOURS[moment.kind]))


def time_line(recording: Recording) -> Iterator[Text]:
    """Yield a line for each event; of consecutive feedback messages only the first, the rate and the last are shown."""
    waiting: list[Moment] = []
    for moment in recording.moments:
        if moment.kind is Kind.FEEDBACK:
            waiting.append(moment)
            continue
        yield from _feedback(waiting)
        waiting = []
        yield line(moment)
    yield from _feedback(waiting)


def _feedback(moments: list[Moment]) -> Iterator[Text]:
    if not moments:
        return
    yield line(moments[0])
    if len(moments) > 2:
        rate = (len(moments) - 1) / max(moments[-1].t - moments[0].t, 1e-9)
        yield Text(f"{'':12}… {len(moments) - 2} more, at {rate:.1f} Hz", COLOURS[Kind.FEEDBACK])
    if len(moments) > 1:
        yield line(moments[-1])
