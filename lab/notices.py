"""Says below a cell that runs a `ros2` or `course` command what it waits for."""

from __future__ import annotations

import re
from collections.abc import Callable
from contextlib import nullcontext
from typing import Any

from IPython.core.getipython import get_ipython

from ros_runtime.cell_notice import notice
from ros_runtime.workarounds.jupyterlab_page import save_notebook

_ROS2 = re.compile(r"(?:^|[\s;&|])(ros2 \w+(?: \w+)?)")
_COURSE = re.compile(r"(?:^|[\s;&|/])(course \w+)")
_OF_THE_NOTEBOOK = ("course check", "course submit")  # they read what is saved


def announce_commands(shell: Any) -> None:
    """Show a notice while a cell runs a `ros2` or `course` command, which takes seconds before it prints.

    A command that reads the notebook has it saved first.
    """
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
                if found and found[1] in _OF_THE_NOTEBOOK:
                    save_notebook()
                run(command)
        finally:
            shell.var_expand = expand

    shell.system = run_with_notice


if hasattr(get_ipython(), "kernel"):  # in a notebook
    announce_commands(get_ipython())
