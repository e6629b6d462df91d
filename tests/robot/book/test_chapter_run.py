"""A small chapter, executed and converted to a page of the book."""

from __future__ import annotations

import os
import signal
from pathlib import Path, PurePosixPath
from threading import Timer

import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

from autograder.classroom.book.chapter_run import execute, processes_in
from autograder.classroom.book.links import Links
from autograder.classroom.book.reader_copy import reader_copy
from autograder.classroom.book.still_widgets import VIEW, VIEW_CAPTION
from ros_runtime.course_error import CommandFailed


def write_chapter(file: Path, *sources: str) -> nbformat.NotebookNode:
    cells = [new_code_cell(source, id=f"cell-{number}") for number, source in enumerate(sources, start=1)]
    notebook = new_notebook(cells=[new_markdown_cell("# 1 · A chapter", id="title"), *cells])
    nbformat.write(notebook, file)
    return notebook


def test_a_chapter_has_its_outputs_and_the_last_picture_of_the_live_view(tmp_path: Path) -> None:
    notebook = write_chapter(
        tmp_path / "01_a.ipynb",
        "import lab\n\nlab.start_robot()\nlab.watch_robot()",
        'prediction_1 = lab.predict("services", 1)\nprediction_1',
        "prediction_1.require()\nlab.stop_watching()\nprint(lab.mode())",
        "prediction_1.reply()",
        "lab.stop_everything()",
    )
    progress = []
    executed = execute(
        tmp_path / "01_a.ipynb", tmp_path, on_cell=lambda cell, of: progress.append((cell, of))
    )
    assert executed.left_behind == []
    assert "STANDING" in executed.text("cell-3")
    assert progress[-1] == (7, 7)  # including a cell that makes the prediction

    copy = reader_copy(notebook, executed.notebook, Links(PurePosixPath("chapters/01_a.ipynb"), ()))
    outputs = {cell.id: cell.outputs for cell in copy.cells if cell.cell_type == "code"}
    assert any(
        "data:image/jpeg;base64,/9j/" in output.get("data", {}).get("text/html", "")
        for output in outputs["cell-1"]
    )
    assert VIEW_CAPTION in str(outputs["cell-1"])
    assert VIEW not in str(outputs)
    assert "widgets" not in copy.metadata


@pytest.mark.parametrize(
    ("source", "said"),
    [
        ("1 / 0", "01_a.ipynb, cell cell-2: ZeroDivisionError: division by zero"),
        ("import os\nos._exit(1)", "01_a.ipynb, cell cell-2: its kernel died"),
    ],
)
def test_a_chapter_that_fails_names_the_cell(tmp_path: Path, source: str, said: str) -> None:
    write_chapter(tmp_path / "01_a.ipynb", "print(1)", source, "print(2)")
    with pytest.raises(CommandFailed) as failed:
        execute(tmp_path / "01_a.ipynb", tmp_path)
    assert str(failed.value) == said


def test_ctrl_c_ends_the_kernel_and_is_reported(tmp_path: Path) -> None:
    write_chapter(tmp_path / "01_a.ipynb", "import time\nprint(1)\ntime.sleep(60)")
    began = []

    def press_ctrl_c(cell: int, of: int) -> None:
        if cell == 2:
            began.append(Timer(1.0, os.kill, [os.getpid(), signal.SIGINT]))
            began[0].start()

    with pytest.raises(KeyboardInterrupt):
        execute(tmp_path / "01_a.ipynb", tmp_path, on_cell=press_ctrl_c)
    assert began
    assert processes_in(tmp_path) == []
