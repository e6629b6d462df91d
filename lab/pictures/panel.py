"""The place of the live picture beside the notebook: a panel of JupyterLab's right side bar."""

from __future__ import annotations

import os
import time
from html import escape
from pathlib import Path

import ipywidgets
from sidecar import Sidecar

from ros_runtime.notebook_domains import NOTEBOOK

TITLE = "Robot"  # by which the course's extension of JupyterLab knows an old panel and closes it
BEAT_PERIOD = 1.0  # s between two texts
SILENCE = 8  # s without a text, after which the panel shows that nothing draws into it any more
_STYLE = f"""<style>
.course-live {{ width: 100%; margin: 0; }}
.course-live > * {{ width: auto; max-width: 100%; margin: 2px 0; }}
.course-live img {{ width: 100%; height: auto; }}
.course-live:not(:has(.course-ended)) img {{ visibility: hidden; }}
.course-live .widget-html-content {{ padding: 0 4px; white-space: normal; overflow-wrap: anywhere; line-height: 1.4; }}
.course-live p {{ margin: 0.3em 0; }}
.course-live .course-ended {{ visibility: hidden; animation: course-ended 0s {SILENCE}s forwards; font-weight: bold; }}
.course-live img.jupyter-widgets-disconnected, .course-live.course-still img {{ opacity: 0.4; }}
.course-live .jupyter-widgets-disconnected .course-said {{ display: none; }}
.course-live .jupyter-widgets-disconnected .course-ended {{ visibility: visible; }}
.course-live.jupyter-widgets-disconnected::before, .course-live .jupyter-widgets-disconnected::before
{{ display: none; }}
@keyframes course-ended {{ to {{ visibility: visible; }} }}
</style>"""
_ENDED = (
    "This picture no longer moves: there is no connection to the notebook's kernel. If that stays so, the kernel has "
    "ended, and its robot with it, or the notebook is closed: run the notebook's cells again, from the first one."
)


class Panel:
    """A panel with the picture and a line of text, which JupyterLab shows again when its page is loaded again.

    The page notices by itself that the robot has ended: each text restarts an animation, whose end shows a sentence. A
    notebook that is opened again shows the last text until its kernel is found, which takes some seconds.
    """

    def __init__(self, picture: ipywidgets.Image) -> None:
        self._notebook = Path(os.environ.get(NOTEBOOK, "this notebook")).name
        self._written = ""
        self._text = ipywidgets.HTML()
        self._next_beat = 0.0  # s, time.monotonic()
        self._box = ipywidgets.VBox([ipywidgets.HTML(_STYLE), picture, self._text])
        self._box.add_class("course-live")
        self._sidecar: Sidecar | None = None
        self.open()

    def open(self) -> None:
        """Open the panel, again if it is open, because its reader may have closed it."""
        self.close()
        self._sidecar = Sidecar(title=TITLE)
        self._sidecar.append_display_data(self._box)

    def write(self, text: str, *, is_live: bool = True) -> None:
        """Show a line of text below the picture, and whose robot it is; show the same text at most once a second.

        A picture that is not live is dimmed.
        """
        (self._box.remove_class if is_live else self._box.add_class)("course-still")
        now = time.monotonic()
        if text != self._written or now >= self._next_beat:
            self._written, self._next_beat = text, now + BEAT_PERIOD
            # the time makes every text a new one, so that the animation restarts
            ended = f'<p class="course-ended" data-time="{now:.1f}">{_ENDED}</p>'
            said = f'<p class="course-said">{escape(text)}</p>'
            self._text.value = f"{said}<p>The robot of {escape(self._notebook)}</p>{ended}"

    def close(self) -> None:
        """Remove the panel."""
        if self._sidecar:
            self._sidecar.close()
