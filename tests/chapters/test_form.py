"""What holds for every chapter: its form in git, its pictures, and that it leaves nothing running."""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import nbformat
import pytest
from execution import CHAPTERS, Executed, processes_in

NAMES = sorted(path.stem for path in CHAPTERS.glob("*.ipynb"))
MOST_WORDS = 2000  # between two things to do; at 130 words a minute a quarter of an hour


def read(name: str) -> nbformat.NotebookNode:
    return nbformat.read(CHAPTERS / f"{name}.ipynb", as_version=4)


def markdown(name: str) -> str:
    return "\n".join(cell.source for cell in read(name).cells if cell.cell_type == "markdown")


def test_there_are_chapters() -> None:
    assert [name[:2] for name in NAMES] == ["01", "02", "03", "04", "07"]


@pytest.mark.parametrize("name", NAMES)
def test_it_is_stored_without_outputs_and_with_stable_ids(name: str) -> None:
    notebook = read(name)
    assert (notebook.nbformat, notebook.nbformat_minor) == (4, 5)
    assert notebook.metadata.kernelspec.name == "python3"
    code = [cell for cell in notebook.cells if cell.cell_type == "code"]
    assert all(cell.outputs == [] and cell.execution_count is None for cell in code)
    ids = [cell.id for cell in notebook.cells]
    assert len(set(ids)) == len(ids)
    assert all(re.fullmatch(r"[a-z0-9-]+", cell_id) for cell_id in ids)


@pytest.mark.parametrize("name", NAMES)
def test_it_has_the_parts_of_a_lesson(name: str) -> None:
    text = markdown(name)
    for part in (
        "After this chapter you can",
        "## Why",
        "**Predict",
        "## Break it",
        "## Fix it",
        "## Pitfall",
    ):
        assert part in text, part
    for part in ("expects of you", "## Quiz", "## Your turn", "./course check", "## What comes next"):
        assert part in text, part


@pytest.mark.parametrize("name", NAMES)
def test_there_is_something_to_do_every_quarter_of_an_hour(name: str) -> None:
    words = 0
    for cell in read(name).cells:
        words = 0 if cell.cell_type == "code" else words + len(cell.source.split())
        assert words < MOST_WORDS, cell.id


@pytest.mark.parametrize("name", NAMES)
def test_every_drawing_exists_and_has_an_alternative_text(name: str) -> None:
    images = re.findall(r"!\[(.*?)\]\((.*?)\)", markdown(name), re.DOTALL)
    assert images
    for alternative, path in images:
        assert len(alternative) > 40, path
        assert "<title>" in (CHAPTERS / path).read_text()


@pytest.mark.parametrize("name", NAMES)
def test_it_runs_and_every_picture_it_makes_has_words_for_it(
    name: str, executed: Callable[[str], Executed]
) -> None:
    chapter = executed(name)
    shown = [
        output.data["text/html"]
        for cell in chapter.notebook.cells
        if cell.cell_type == "code"
        for output in cell.outputs
        if "text/html" in output.get("data", {})
    ]
    drawings = [html for html in shown if "<svg" in html]
    pictures = [html for html in shown if "<img" in html]
    assert drawings
    assert all("<title>" in html and "<desc>" in html for html in drawings)
    assert all(re.search(r'alt="[^"]{20,}"', html) for html in pictures)


@pytest.mark.parametrize("name", NAMES)
def test_it_leaves_no_process_behind(name: str, executed: Callable[[str], Executed]) -> None:
    assert executed(name).left_behind == []


@pytest.mark.parametrize("name", NAMES)
def test_its_quiz_marks_every_answer_with_a_reason(name: str, executed: Callable[[str], Executed]) -> None:
    chapter = executed(name)
    cells = [cell.id for cell in chapter.notebook.cells if re.fullmatch(r"quiz-\d+-answer", cell.id)]
    assert len(cells) >= 5
    for cell_id in cells:
        assert re.match(r"a: (Right|Not this one)\. .{30,}", chapter.text(cell_id)), cell_id


def test_a_run_is_seen_while_it_runs(tmp_path: Path) -> None:
    """The check for processes left behind does see processes."""
    with subprocess.Popen([sys.executable, "-c", "input()"], cwd=tmp_path, stdin=subprocess.PIPE) as process:
        assert [seen.pid for seen in processes_in(tmp_path)] == [process.pid]
        process.communicate(b"\n")
