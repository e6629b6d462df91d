"""Fills the gaps of a chapter with lines other than their solutions.

The lines are in gaps/<chapter>.yaml, by the file of the gap. An entry has all its `lines`, or a `change`: a part of the
solution, and what replaces it. With `says` the lines are wrong and the reply has these words; else they are right.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import nbformat
import pytest
import yaml
from execution import CHAPTERS
from kernels import CellError, Kernel

from chapter_gaps import gaps_of
from lab.learning.gap_cells import MAGIC, fill, fill_gaps

WRITEFILE = "%%writefile "
TRIALS = Path(__file__).with_name("gaps")


@dataclass(frozen=True)
class Trial:
    """Lines for the gap of a file, and what the reply says; None: they are accepted."""

    file: str
    says: str | None = None
    lines: str = ""
    change: Mapping[str, str] = field(default_factory=dict)

    def __str__(self) -> str:
        return f"{self.file}: {self.says or 'accepted'}"

    def lines_beside(self, solution: str) -> str:
        """Return the lines for the gap that has this solution."""
        lines = self.lines or solution
        for part, replaced in self.change.items():
            assert lines.count(part) == 1, f"{part!r} is in these lines {lines.count(part)} times:\n{lines}"
            lines = lines.replace(part, replaced)
        return lines


def trials_of(chapter: str) -> list[Trial]:
    """Return the trials of a chapter's gaps in the order of its file."""
    trials = yaml.safe_load((TRIALS / f"{chapter}.yaml").read_text(encoding="utf-8"))
    return [Trial(file, **entry) for file, entries in trials.items() for entry in entries]


class GapTrials:
    """A kernel in a folder with all programs of the chapter, as if its cells had been run.

    `solved` are the programs with the solutions in their gaps.
    """

    def __init__(self, chapter: str, folder: Path) -> None:
        notebook = nbformat.read(CHAPTERS / f"{chapter}.ipynb", as_version=4)
        self._gaps = gaps_of(notebook)
        self.solved = {file: fill(program, lines) for file, (program, lines) in self._gaps.items()}
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

    def require_reply(self, trial: Trial) -> None:
        """Fill the gap; the test fails if the reply is not as the trial says."""
        lines = trial.lines_beside(self._gaps[trial.file][1])
        fill_in = self.accept if trial.says is None else self.reply
        printed, expected = fill_in(trial.file, lines), trial.says or f"✓ {trial.file}: "
        assert expected in printed, printed

    def reply(self, file: str, lines: str) -> str:
        """Fill the gap with these lines and return the printed reply; the test fails if they are accepted."""
        with pytest.raises(CellError) as raised:
            self.accept(file, lines)
        return str(raised.value)

    def accept(self, file: str, lines: str) -> str:
        """Fill the gap with these lines and return the printed reply; the test fails if they are rejected."""
        return self._kernel.run(f"%%gap {file}\n{fill(self._gaps[file][0], lines + chr(10))}")

    def end(self) -> None:
        """End the kernel and what runs in it."""
        self._kernel.shut_down()
