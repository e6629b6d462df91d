"""Says below a running cell what it waits for and for how long, without a line in the cell's output."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import copy_context
from html import escape
from typing import Any

from IPython.core.getipython import get_ipython
from IPython.display import display

DELAY = 0.5  # s; a step that ends sooner needs no notice
PERIOD = 0.5  # s between two updates of the time

_only_one = threading.Lock()  # of a step and its parts, the step says what goes on


class CellNotice:
    """A text below the running cell and how long it has been shown, in s; the end of the `with` block removes it.

    It appears once the block has taken `delay` s (default: DELAY). It is not printed, so nothing that reads the cell's
    output receives it. Outside a notebook, and in threads that the cell has started, nothing is shown.
    """

    def __init__(self, text: str = "", delay: float | None = None) -> None:
        self._text, self._since = text, time.monotonic()
        self._delay = DELAY if delay is None else delay
        self._shown: Any = None  # IPython's handle of the display, once there is one
        self._drawing = threading.Lock()
        self._ended = threading.Event()
        # the context knows the cell
        self._thread = threading.Thread(target=copy_context().run, args=(self._keep_drawing,), daemon=True)

    def __enter__(self) -> CellNotice:
        in_cell = hasattr(get_ipython(), "kernel") and threading.current_thread() is threading.main_thread()
        if in_cell and _only_one.acquire(blocking=False):
            self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        if self._thread.ident:  # it was started
            self._ended.set()
            self._thread.join()
            self.show("")
            _only_one.release()

    def show(self, text: str) -> None:
        """Replace the text; its time begins anew."""
        self._text, self._since = text, time.monotonic()
        if self._shown:
            self._draw()

    def _keep_drawing(self) -> None:
        pause = self._delay
        while not self._ended.wait(pause):
            pause = PERIOD
            self._draw()

    def _draw(self) -> None:
        with self._drawing:
            if self._shown:
                self._shown.update(self._content(), raw=True)
            elif self._text:
                self._shown = display(self._content(), raw=True, display_id=True)

    def _content(self) -> dict[str, str]:
        """Return the text and the seconds; a screen reader announces the text once, and never the seconds."""
        seconds = int(time.monotonic() - self._since)
        html = f'<em role="status">{escape(self._text)}</em>'
        if seconds:
            html = f'<em>{escape(self._text)}</em> <span aria-hidden="true">{seconds} s</span>'
        content = {"text/html": f'<div class="course-notice">{html}</div>', "text/plain": self._text}
        return content if self._text else {"text/plain": ""}


@contextmanager
def notice(text: str) -> Iterator[None]:
    """Show a text below the cell, with the time, if the `with` block takes longer than DELAY."""
    with CellNotice(text):
        yield
