"""Leaves the code of others out of tracebacks: an interrupted cell shows only lines that the student wrote."""

from __future__ import annotations

import sys
import traceback
from types import TracebackType
from typing import Any

from IPython.core.getipython import get_ipython

from ros_runtime.project import PROJECT

OF_OTHERS = (  # beginnings of file names
    sys.prefix,
    sys.base_prefix,
    *(
        str(PROJECT / folder)
        for folder in ("autograder", "chapters/support", "lab", "robot_sim", "ros_runtime")
    ),
    "<frozen",
)


def announce_interrupts(shell: Any) -> None:
    """Let an interrupted cell say in which of its lines, without the frames of the lab and of libraries."""

    def show(
        shell: Any,
        kind: type[BaseException],
        interrupt: BaseException,
        trace: TracebackType | None,
        tb_offset: int | None = None,
    ) -> list[str]:
        lines = [
            f"{_place(shell, frame)}: {frame.line}"
            for frame in traceback.extract_tb(trace)
            if _is_own(shell, frame.filename)
        ]
        shown = [*lines, f"{kind.__name__}: interrupted"]
        shell._showtraceback(kind, interrupt, shown)
        return shown

    shell.set_custom_exc((KeyboardInterrupt,), show)


def _is_own(shell: Any, file: str) -> bool:
    """Whether a line is in a cell or in a file of the student; a compiled library has a relative name."""
    return bool(shell.compile.format_code_name(file)) or (
        file.startswith("/") and not file.startswith(OF_OTHERS)
    )


def _place(shell: Any, frame: traceback.FrameSummary) -> str:
    label, name = shell.compile.format_code_name(frame.filename) or ("File", frame.filename)
    return f"{label} {name}, line {frame.lineno}"


if hasattr(get_ipython(), "kernel"):  # in a notebook
    announce_interrupts(get_ipython())
