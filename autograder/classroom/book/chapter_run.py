"""Executes a chapter from top to bottom, with every prediction and question answered and every gap filled."""

from __future__ import annotations

import hashlib
import os
import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import nbformat
import psutil
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError, CellTimeoutError, DeadKernelError
from nbformat.v4 import new_code_cell

from lab.learning.gap_cells import fill_gaps
from robot_sim.body import MissingParts, body_named
from ros_cli.real_ros2 import path_with_ros2
from ros_runtime.course_error import CommandFailed

# s; building interfaces takes ten seconds on an idle machine, and minutes on a busy one
CELL_TIMEOUT = 300
# Folders that a chapter's outputs depend on, besides its own text.
SOURCE_FOLDERS = ("humanoid_interfaces", "lab", "robot_sim", "ros_cli", "ros_runtime")
SOURCES = {".py", ".xml", ".msg", ".srv", ".action"}


@dataclass(frozen=True)
class Executed:
    """A chapter after its run."""

    notebook: nbformat.NotebookNode
    left_behind: list[str]  # processes

    def text(self, cell_id: str) -> str:
        """Return the text that a cell printed."""
        return "".join(output.text for output in self._outputs[cell_id] if output.output_type == "stream")

    def html(self, cell_id: str) -> str:
        """Return the HTML that a cell displayed."""
        return "".join(
            output.data.get("text/html", "") for output in self._outputs[cell_id] if "data" in output
        )

    @cached_property
    def _outputs(self) -> dict[str, list[nbformat.NotebookNode]]:
        return {cell.id: cell.outputs for cell in self.notebook.cells if cell.cell_type == "code"}


def missing_parts(chapter: Path) -> str:
    """Return why a chapter cannot run here: it starts an optional robot that is not installed. "" if it can."""
    cells = nbformat.read(chapter, as_version=4).cells
    code = "\n".join(cell.source for cell in cells if cell.cell_type == "code")
    for robot in re.findall(r'robot="(\w+)"', code):
        try:
            body_named(robot)
        except MissingParts as error:
            return str(error)
    return ""


def execute(
    chapter: Path, folder: Path, *, on_cell: Callable[[int, int], object] = lambda cell, of: None
) -> Executed:
    """Run all cells of a chapter in a folder; `on_cell` gets each cell's number and the number of cells.

    Raises:
        KeyboardInterrupt: Ctrl-C; the kernel has been ended.
    """
    notebook = answered(nbformat.read(chapter, as_version=4))
    reached = notebook.cells[0]

    def begin(cell: nbformat.NotebookNode, cell_index: int) -> None:
        nonlocal reached
        reached = cell
        on_cell(cell_index + 1, len(notebook.cells))

    client = NotebookClient(
        notebook,
        timeout=CELL_TIMEOUT,
        kernel_name="python3",
        resources={"metadata": {"path": str(folder)}},
        on_cell_start=begin,
        extra_arguments=["--log-level=ERROR"],  # the kernel's log would otherwise go to the terminal
    )
    try:
        _execute(client)
    except CellExecutionError as error:
        raise CommandFailed(f"{chapter.name}, cell {reached.id}: {error.ename}: {error.evalue}") from error
    except CellTimeoutError as error:
        raise CommandFailed(
            f"{chapter.name}, cell {reached.id}: did not end within {CELL_TIMEOUT} s"
        ) from error
    except DeadKernelError as error:
        raise CommandFailed(f"{chapter.name}, cell {reached.id}: its kernel died") from error
    return Executed(notebook, [str(process) for process in processes_in(folder)])


def _execute(client: NotebookClient) -> None:
    """Run the notebook with the `ros2` commands on the PATH, as in `course lab`."""
    try:
        client.execute(env={**os.environ, "PATH": path_with_ros2(os.environ["PATH"])})
    except Exception as error:
        # On Ctrl-C nbclient ends the kernel in a task, and then raises an error because it has no kernel.
        if hasattr(client, "_async_cleanup_kernel_future"):
            raise KeyboardInterrupt from error
        raise


def answered(notebook: nbformat.NotebookNode) -> nbformat.NotebookNode:
    """Return a chapter with its gaps filled, and a cell after each prediction and question that answers "a"."""
    fill_gaps(notebook)
    cells = []
    for cell in notebook.cells:
        cells.append(cell)
        if asked := re.match(r"(\w+) = lab\.(predict|quiz)\(", cell.source):
            verb = "choose" if asked[2] == "predict" else "answer"
            cells.append(new_code_cell(f'{asked[1]}.{verb}("a")', id=f"{cell.id}-a"))
    notebook.cells = cells
    return notebook


def processes_in(folder: Path) -> list[psutil.Process]:
    """Return the processes whose working directory is in a folder: a chapter's kernel, its robot and its nodes."""

    def runs_there(process: psutil.Process) -> bool:
        try:
            is_zombie = process.status() == psutil.STATUS_ZOMBIE
            return not is_zombie and Path(process.cwd()).is_relative_to(folder)
        except psutil.Error:
            return False

    return [process for process in psutil.process_iter() if runs_there(process)]


class KeptRuns:
    """Executed notebooks in a folder, named by a hash of the chapter and of the code that it runs."""

    def __init__(self, folder: Path, project: Path) -> None:
        self._folder = folder
        self._project = project

    def of(self, chapter: Path) -> nbformat.NotebookNode | None:
        """Return the stored run of the chapter's present content, or None."""
        kept = self._file(chapter)
        return nbformat.read(kept, as_version=4) if kept.exists() else None

    def keep(self, chapter: Path, executed: nbformat.NotebookNode) -> None:
        """Store a run and remove the chapter's earlier ones; the file is written atomically."""
        self._folder.mkdir(parents=True, exist_ok=True)
        kept = self._file(chapter)
        for earlier in self._folder.glob(f"{chapter.stem}-*.ipynb"):
            earlier.unlink()
        half = kept.with_suffix(".half")
        nbformat.write(executed, half)
        half.replace(kept)

    def _file(self, chapter: Path) -> Path:
        digest = hashlib.sha256(chapter.read_bytes() + self._sources_hash).hexdigest()
        return self._folder / f"{chapter.stem}-{digest[:16]}.ipynb"

    @cached_property
    def _sources_hash(self) -> bytes:
        digest = hashlib.sha256()
        for name in SOURCE_FOLDERS:
            for path in sorted((self._project / name).rglob("*")):
                if path.suffix in SOURCES:
                    digest.update(f"{path.relative_to(self._project)}\n".encode() + path.read_bytes())
        return digest.digest()
