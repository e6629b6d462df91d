"""Fills the gaps of a chapter with lines other than their solutions."""

from __future__ import annotations

from pathlib import Path

import nbformat
import pytest
from execution import CHAPTERS
from kernels import CellError, Kernel

from lab.learning.gap_cells import MAGIC, fill, fill_gaps, gaps_of

WRITEFILE = "%%writefile "


class GapTrials:
    """A kernel in a folder with all programs of the chapter, as if its cells had been run.

    `solved` are the programs with the solutions in their gaps.
    """

    def __init__(self, chapter: str, folder: Path) -> None:
        notebook = nbformat.read(CHAPTERS / f"{chapter}.ipynb", as_version=4)
        self._programs = {file: program for file, (program, _) in gaps_of(notebook).items()}
        self.solved = {file: fill(program, lines) for file, (program, lines) in gaps_of(notebook).items()}
        fill_gaps(notebook)
        for cell in notebook.cells:
            for magic in (MAGIC, WRITEFILE):
                if cell.source.startswith(magic):
                    line, _, program = cell.source.partition("\n")
                    written = folder / line.removeprefix(magic).strip()
                    written.parent.mkdir(parents=True, exist_ok=True)
                    written.write_text(program)
        self._kernel = Kernel(folder)

    def run(self, code: str, timeout: float = 90.0) -> str:
        """Run a cell that a gap needs before it, such as `lab.start_robot()`; return what it printed."""
        return self._kernel.run(code, timeout)

    def reply(self, file: str, lines: str) -> str:
        """Fill the gap with these lines and return the printed reply; the test fails if they are accepted."""
        with pytest.raises(CellError) as raised:
            self._kernel.run(f"%%gap {file}\n{fill(self._programs[file], lines + chr(10))}")
        return str(raised.value)

    def accept(self, file: str, lines: str) -> str:
        """Fill the gap with these lines and return the printed reply; the test fails if they are rejected."""
        return self._kernel.run(f"%%gap {file}\n{fill(self._programs[file], lines + chr(10))}")

    def end(self) -> None:
        """End the kernel and what runs in it."""
        self._kernel.shut_down()
