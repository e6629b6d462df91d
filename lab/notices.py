"""Says below a running cell what it waits for, without a line in the cell's output."""

from __future__ import annotations

import re
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, nullcontext
from contextvars import copy_context
from html import escape
from typing import Any

from IPython.core.getipython import get_ipython
from IPython.display import display

DELAY = 0.8  # s; a step that ends sooner needs no notice
_ROS2 = re.compile(r"(?:^|[\s;&|])(ros2 \w+(?: \w+)?)")
_COURSE = re.compile(r"(?:^|[\s;&|/])(course \w+)")

_only_one = threading.Lock()  # of a step and its parts, the step says what goes on


@contextmanager
def notice(text: str) -> Iterator[None]:
    """Show a text below the cell if the `with` block takes longer than DELAY, and remove it at the end.

    The text is not printed: nothing that reads the cell's output meets it. Outside a notebook, and in threads that the
    cell has started, nothing is shown.
    """
    shell: Any = get_ipython()
    is_cell = hasattr(shell, "kernel") and threading.current_thread() is threading.main_thread()
    if not is_cell or not _only_one.acquire(blocking=False):
        yield
        return
    shown: list[Any] = []
    content = {"text/html": f'<em role="status">{escape(text)}</em>', "text/plain": text}
    timer = threading.Timer(
        DELAY,
        copy_context().run,  # the context knows the cell
        (lambda: shown.append(display(content, raw=True, display_id=True)),),
    )
    timer.start()
    try:
        yield
    finally:
        timer.cancel()
        timer.join()
        _only_one.release()
        for handle in shown:
            handle.update({"text/plain": ""}, raw=True)


def announce_commands(shell: Any) -> None:
    """Show a notice while a cell runs a `ros2` or `course` command, which takes seconds before it prints."""
    run: Callable[[str], None] = shell.system
    expand: Callable[..., str] = shell.var_expand
    further_frames = 2  # run_with_notice and expand_for_caller

    def expand_for_caller(command: str, depth: int = 0, *more: Any) -> str:
        return expand(command, depth + further_frames, *more)

    def run_with_notice(command: str) -> None:
        # IPython looks for the variables of a command in the frame that called system()
        shell.var_expand = expand_for_caller
        try:
            words = ""
            if found := _ROS2.search(command):
                words = f"{found[1]} runs. It first finds the nodes, which takes seconds, on a busy machine up to 20 s."
            elif found := _COURSE.search(command):
                words = f"{found[1]} runs. It first loads the course, which takes some seconds."
            with notice(words) if words else nullcontext():
                run(command)
        finally:
            shell.var_expand = expand

    shell.system = run_with_notice


if hasattr(get_ipython(), "kernel"):  # in a notebook
    announce_commands(get_ipython())
