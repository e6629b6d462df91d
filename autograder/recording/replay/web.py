"""Shows a recording in the web view, at the pace of the arena's clock."""

from __future__ import annotations

import time
from collections.abc import Callable

from autograder.recording.replay.body import RecordedBody
from autograder.recording.replay.captions import captions
from autograder.recording.replay.recording import Moment, Recording, Span
from robot_sim.views.web_view import WebView

FRAME_PERIOD = 0.04  # s, from one posture to the next
END_PAUSE = 1.5  # s, at the end, before the recording begins again
CAPTION_WIDTH = 100  # characters


def play(
    recording: Recording,
    span: Span,
    port: int,
    *,
    on_ready: Callable[[str], None],
    on_moment: Callable[[Moment], None],
    keep_running: Callable[[], bool] = lambda: True,
) -> None:
    """Show the robot in this span in a loop, with captions.

    Args:
        recording: the recording to show.
        span: the part to show.
        port: the view's port; 0: the first free port from 8080 on.
        on_ready: called with the view's address.
        on_moment: called with each moment at its time, in the first round only.
        keep_running: called before every frame; False ends the loop.

    Raises:
        OSError: the port is taken.
        ImportError: this MuJoCo is older than 4.0 and has no web viewer.
    """
    body = RecordedBody(recording)
    body.show(span.start)
    view = WebView(body.humanoid, port)
    try:
        on_ready(view.url)
        remaining = [moment for moment in recording.moments if span.start <= moment.t <= span.end]
        began = time.monotonic()
        while keep_running():
            elapsed = time.monotonic() - began
            t = min(span.start + elapsed, span.end)
            body.show(t)
            view.write(captions(t, recording.moments, CAPTION_WIDTH))
            view.show()
            while remaining and remaining[0].t <= t:
                on_moment(remaining.pop(0))
            if elapsed > span.end - span.start + END_PAUSE:
                began = time.monotonic()
            time.sleep(FRAME_PERIOD)
    finally:
        view.close()
