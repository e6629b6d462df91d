"""Tells a person's terminal from files, pipes and the cells of a notebook, where commands are typed differently."""

from __future__ import annotations

import os
from typing import IO

from ros_runtime.notebook_domains import VARIABLE

CELL_VARIABLE = "JPY_PARENT_PID"  # Jupyter sets it for kernels, and so for the commands in their cells


def as_typed(command: str) -> str:
    """Return a command of ./course as it is typed where this program runs: in a terminal, or in a notebook's cell.

    The terminals of the lab have the command also in other folders than the course's.
    """
    launcher = "course" if VARIABLE in os.environ and not os.path.exists("course") else "./course"
    return f"{'!course' if CELL_VARIABLE in os.environ else launcher} {command}"


def is_terminal(stream: IO[str]) -> bool:
    """Return whether a stream is a terminal, whose lines the course breaks; the page of a notebook breaks its own."""
    return stream.isatty() and CELL_VARIABLE not in os.environ
