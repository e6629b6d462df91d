"""Shows a recording in the web view, at the pace of the arena's clock."""

from __future__ import annotations

import time
from collections.abc import Callable

from autograder.recording.replay.body import RecordedBody
from autograder.recording.replay.captions import captions
from autograder.recording.replay.recording import Moment, Recording, Span
from robot_sim.views.web_view import WebView

FRAME = 0.04  # s, between two postures
PAUSE = 1.5  # s at the end, before it begins again
LETTERS = 100  # of a caption's line


def play(
    recording: Recording,
    span: Span,
    port: int,
    *,
    ready: Callable[[str], None],
    tell: Callable[[Moment], None],
    goes_on: Callable[[], bool] = lambda: True,
) -> None:
    """Show the robot in this span in a loop, with captions; `tell` gets the moments of the first round.

    Args:
        recording: what to show.
        span: which part of it.
        port: where the view listens; 0: the first free one from 8080 on.
        ready: gets the view's address.
        tell: gets each moment when its time comes.
        goes_on: called before every frame; False ends the loop.

    Raises:
        NoRecording: the recorded robot is another one.
        OSError: the port is taken.
        ImportError: this MuJoCo is older than 4.0 and has no web viewer.
    """
    body = RecordedBody(recording)
    body.show(span.start)
    view = WebView(body.humanoid, port)
    try:
        ready(view.url)
        untold = [moment for moment in recording.moments if span.start <= moment.t <= span.end]
        began = time.monotonic()
        while goes_on():
            elapsed = time.monotonic() - began
            t = min(span.start + elapsed, span.end)
            body.show(t)
            view.write(captions(t, recording.moments, LETTERS))
            view.show()
            while untold and untold[0].t <= t:
                tell(untold.pop(0))
            if elapsed > span.end - span.start + PAUSE:
                began = time.monotonic()
            time.sleep(FRAME)
    finally:
        view.close()
