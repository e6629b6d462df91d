"""The chapters, executed once each in a folder of their own, as a student would from top to bottom."""

from __future__ import annotations

import os
import re
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import nbformat
import psutil
from nbclient import NotebookClient
from nbformat.v4 import new_code_cell

from lab.gap_cells import fill_gaps
from ros_cli.real_ros2 import path_with_ros2

CHAPTERS = Path(__file__).resolve().parents[3] / "chapters"
CELL_TIMEOUT = (
    300  # s; building interfaces takes ten seconds alone, and minutes on a machine that everybody uses
)


@dataclass(frozen=True)
class Executed:
    """A chapter after its run."""

    notebook: nbformat.NotebookNode
    left_behind: list[str]  # processes

    def text(self, cell_id: str) -> str:
        """What a cell printed."""
        return "".join(output.text for output in self._outputs[cell_id] if output.output_type == "stream")

    def html(self, cell_id: str) -> str:
        """The HTML that a cell showed."""
        return "".join(
            output.data.get("text/html", "") for output in self._outputs[cell_id] if "data" in output
        )

    @cached_property
    def _outputs(self) -> dict[str, list[nbformat.NotebookNode]]:
        return {cell.id: cell.outputs for cell in self.notebook.cells if cell.cell_type == "code"}


def execute(name: str, folder: Path) -> Executed:
    """Run all cells of a chapter; a cell that raises fails the test with its traceback."""
    notebook = answered(nbformat.read(CHAPTERS / f"{name}.ipynb", as_version=4))
    with_ros2 = {**os.environ, "PATH": path_with_ros2(os.environ["PATH"])}  # as in `course lab`
    NotebookClient(
        notebook, timeout=CELL_TIMEOUT, kernel_name="python3", resources={"metadata": {"path": str(folder)}}
    ).execute(env=with_ros2)
    return Executed(notebook, [str(process) for process in processes_in(folder)])


def answered(notebook: nbformat.NotebookNode) -> nbformat.NotebookNode:
    """A chapter with its gaps filled, and "a" for each prediction and question, as a student without a mouse does."""
    fill_gaps(notebook)
    cells = []
    for cell in notebook.cells:
        cell.source = cell.source.replace('.answer("")', '.answer("a")')
        cells.append(cell)
        if prediction := re.match(r"(prediction_\d+) = lab\.predict", cell.source):
            cells.append(new_code_cell(f'{prediction[1]}.choose("a")', id=f"{cell.id}-a"))
    notebook.cells = cells
    return notebook


def processes_in(folder: Path) -> list[psutil.Process]:
    """The processes that run in a folder: a chapter's robot and nodes do, and so does its kernel."""

    def runs_there(process: psutil.Process) -> bool:
        try:
            return process.cwd() == str(folder) and process.status() != psutil.STATUS_ZOMBIE
        except psutil.Error:
            return False

    return [process for process in psutil.process_iter() if runs_there(process)]


def in_order(text: str, *parts: str) -> bool:
    """Whether the parts stand in a text one after the other."""
    return re.search(".*?".join(re.escape(part) for part in parts), text, re.DOTALL) is not None
