"""Requirements on the run of every chapter: pictures, predictions, quiz, and no process left running."""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from execution import CHAPTERS, Executed, processes_in

from autograder.classroom.book.still_widgets import models_of

NAMES = sorted(path.stem for path in CHAPTERS.glob("*.ipynb"))
SHORT = {"12_design", "13_two_walkers"}  # two or three predictions, two questions


@pytest.mark.parametrize("name", NAMES)
def test_it_runs_and_every_picture_has_a_text_alternative(
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
    assert drawings or pictures
    assert all("<title>" in html and "<desc>" in html for html in drawings)
    assert all(re.search(r'alt="[^"]{20,}"', html) for html in pictures)
    widgets = models_of(chapter.notebook).values()
    live = [model["state"] for model in widgets if model.get("model_name") == "ImageModel"]
    assert all(len(state["tooltip"]) > 20 for state in live)


@pytest.mark.parametrize("name", NAMES)
def test_it_leaves_no_process_behind(name: str, executed: Callable[[str], Executed]) -> None:
    assert executed(name).left_behind == []


@pytest.mark.parametrize("name", NAMES)
def test_each_prediction_gets_a_reply_after_its_experiment(
    name: str, executed: Callable[[str], Executed]
) -> None:
    chapter = executed(name)
    cells = [cell.id for cell in chapter.notebook.cells if cell.id.endswith("-reply")]
    assert len(cells) >= (2 if name in SHORT else 4)
    for cell_id in cells:
        reply = r"You predicted a: .+\n(Right|It went differently)\. .{30,}\n"
        assert re.fullmatch(reply, chapter.text(cell_id), re.DOTALL), cell_id


@pytest.mark.parametrize("name", NAMES)
def test_its_quiz_marks_every_answer_with_a_reason(name: str, executed: Callable[[str], Executed]) -> None:
    chapter = executed(name)
    cells = [cell.id for cell in chapter.notebook.cells if re.fullmatch(r"quiz-\d+-a", cell.id)]
    assert len(cells) >= (2 if name in SHORT else 5)
    for cell_id in cells:
        assert re.match(r"a: (Right|Not this one)\. .{30,}", chapter.text(cell_id)), cell_id


def test_a_running_chapter_is_detected_as_a_process(tmp_path: Path) -> None:
    """Test the helper that finds leftover processes."""
    folder = tmp_path / "programs"
    folder.mkdir()
    with subprocess.Popen([sys.executable, "-c", "input()"], cwd=folder, stdin=subprocess.PIPE) as process:
        assert [seen.pid for seen in processes_in(tmp_path)] == [process.pid]
        process.communicate(b"\n")
