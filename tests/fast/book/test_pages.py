"""How the book shows a chapter's cells: its links, questions and widgets."""

from __future__ import annotations

from pathlib import Path, PurePosixPath

import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook, new_output

from autograder.classroom.book import chapter_run
from autograder.classroom.book.chapter_run import KeptRuns, answered, missing_parts
from autograder.classroom.book.links import Links
from autograder.classroom.book.reader_copy import HIDDEN_INPUT, reader_copy
from autograder.classroom.book.still_widgets import STATE, VIEW, VIEW_CAPTION, still
from lab.learning.question import read_question
from robot_sim.body import MissingParts
from ros_runtime.project import PROJECT

PAGES = {PurePosixPath(page) for page in ("docs/glossary.md", "docs/robot.md", "chapters/01_a.ipynb")}
LINKS = Links(PurePosixPath("docs/glossary.md"), PAGES)


@pytest.mark.parametrize(
    ("text", "rewritten"),
    [
        ("[a](robot.md) and [b](robot.md#part)", "[a](robot.md) and [b](robot.md#part)"),
        (
            "[1: `x`](../chapters/01_a.ipynb#cell-id=why)",
            '<a class="reference internal" href="../chapters/01_a.html#why">1: `x`</a>',
        ),
        ("[the code](../lab/pictures/film.py), [a folder](../lab)", "the code, a folder"),
        ("[out](https://docs.ros.org/x) [here](#below)", "[out](https://docs.ros.org/x) [here](#below)"),
        ("![a picture](images/x.png)", "![a picture](images/x.png)"),
        ("```\n[code](../lab/pictures/film.py)\n```", "```\n[code](../lab/pictures/film.py)\n```"),
    ],
)
def test_links_lead_to_pages_of_the_book_or_nowhere(text: str, rewritten: str) -> None:
    assert LINKS.rewritten(text) == rewritten


def chapter(*cells: nbformat.NotebookNode) -> nbformat.NotebookNode:
    return new_notebook(cells=[new_markdown_cell("# 1 · A chapter", id="title"), *cells])


def shown(notebook: nbformat.NotebookNode, run: nbformat.NotebookNode | None = None) -> dict:
    """The cells of the book's copy that have the id of a cell of the notebook."""
    copy = reader_copy(notebook, run, LINKS)
    nbformat.validate(copy)
    ids = {cell.id for cell in notebook.cells}
    return {cell.id: cell for cell in copy.cells if cell.id in ids}


def html(cell: nbformat.NotebookNode) -> str:
    return "".join(output.data["text/html"] for output in cell.outputs)


def test_a_prediction_is_a_question_before_the_experiment_and_folded_replies_after_it() -> None:
    cells = shown(
        chapter(
            new_code_cell('prediction_2 = lab.predict("services", 2)\nprediction_2', id="choose"),
            new_code_cell("prediction_2.require()\n\nlab.stop_nodes()", id="run"),
            new_code_cell("prediction_2.reply()", id="reply"),
        )
    )
    question = read_question("services", "predictions", 2)
    assert cells["run"].source == "lab.stop_nodes()"
    assert cells["choose"].metadata.tags == cells["reply"].metadata.tags == [HIDDEN_INPUT]
    assert html(cells["choose"]).count("<li>") == len(question.choices)
    assert "<details>" not in html(cells["choose"])
    assert html(cells["reply"]).count("<details>") == len(question.choices)
    assert html(cells["reply"]).count("Right.") == 1


def test_a_quiz_question_has_its_replies_folded() -> None:
    cells = shown(chapter(new_code_cell('question_1 = lab.quiz("services", 1)\nquestion_1', id="quiz-1")))
    assert html(cells["quiz-1"]).count("Right.") == 1


def test_outputs_are_those_of_the_run_and_the_program_keeps_its_gap() -> None:
    notebook = chapter(
        new_code_cell(
            "%%gap double.py\ndef f(x):\n    # YOUR CODE HERE\n    raise NotImplementedError\n", id="gap"
        ),
        new_markdown_cell("<details>\n\n```python\nreturn 2 * x\n```\n\n</details>", id="solution"),
    )
    run = answered(nbformat.from_dict(notebook))
    assert "return 2 * x" in run.cells[1].source
    run.cells[1].outputs = [new_output("stream", name="stdout", text="✓ double.py: it doubles\n")]
    cell = shown(notebook, run)["gap"]
    assert "YOUR CODE HERE" in cell.source
    assert cell.outputs[0].text.startswith("✓")


def test_every_cell_but_the_first_can_be_linked_to() -> None:
    copy = reader_copy(
        chapter(new_markdown_cell("## Why", id="why"), new_code_cell("1", id="one")), None, LINKS
    )
    sources = [cell.source for cell in copy.cells]
    assert sources == ["# 1 · A chapter", '<span id="why"></span>\n\n## Why', '<span id="one"></span>', "1"]


def test_widgets_are_shown_as_they_were_last() -> None:
    models = {
        "box": {"model_name": "HBoxModel", "state": {"children": ["IPY_MODEL_bar", "IPY_MODEL_button"]}},
        "bar": {
            "model_name": "FloatProgressModel",
            "state": {"description": "turned", "min": 0, "max": 120, "value": 30.0},
        },
        "button": {"model_name": "ButtonModel", "state": {"description": "<Cancel>"}},
        "live": {
            "model_name": "ImageModel",
            "state": {"format": "jpeg"},
            "buffers": [{"path": ["value"], "data": "AAAA", "encoding": "base64"}],
        },
        "slider": {"model_name": "IntSliderModel", "state": {}},
        "choice": {
            "model_name": "SelectionSliderModel",
            "state": {"description": "shortest, m", "_options_labels": ["0", "0.2", "1"], "index": 1},
        },
    }
    box = still("box", models)
    assert '<progress value="30.0" max="120">' in box
    assert "<button disabled>&lt;Cancel&gt;</button>" in box
    assert f'<img src="data:image/jpeg;base64,AAAA" alt="{VIEW_CAPTION}">' in still("live", models)
    assert "there is an interactive control here" in still("slider", models)
    assert "shortest, m: 0.2. In the lab, a slider goes up to 1." in still("choice", models)
    assert "there is an interactive control here" in still("unknown", models)

    notebook = chapter(new_code_cell("widget", id="one"))
    run = nbformat.from_dict(notebook)
    run.cells[1].outputs = [new_output("display_data", {VIEW: {"model_id": "live"}, "text/plain": "Image()"})]
    run.metadata.widgets = {STATE: {"state": models}}
    assert "data:image/jpeg" in html(shown(notebook, run)["one"])


def test_a_run_is_kept_until_the_chapter_or_what_it_runs_changes(tmp_path: Path) -> None:
    (tmp_path / "lab").mkdir()
    module = tmp_path / "lab/module.py"
    module.write_text("x = 1\n")
    file = tmp_path / "01_a.ipynb"
    nbformat.write(chapter(), file)

    def kept() -> KeptRuns:
        return KeptRuns(tmp_path / "runs", tmp_path)

    assert kept().of(file) is None
    kept().keep(file, chapter(new_code_cell("1", id="one")))
    run = kept().of(file)
    assert run
    assert [cell.id for cell in run.cells] == ["title", "one"]

    module.write_text("x = 2\n")
    assert kept().of(file) is None
    kept().keep(file, chapter())
    assert len(list((tmp_path / "runs").iterdir())) == 1  # the earlier run is gone

    nbformat.write(chapter(new_code_cell("2", id="two")), file)
    assert kept().of(file) is None


def test_only_the_chapter_that_starts_the_optional_robot_needs_its_parts(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def without_parts(robot: str) -> None:
        raise MissingParts(f"{robot} needs a package")

    monkeypatch.setattr(chapter_run, "body_named", without_parts)
    chapters = sorted((PROJECT / "chapters").glob("*.ipynb"))
    assert {path.stem: why for path in chapters if (why := missing_parts(path))} == {
        "13_two_walkers": "g1 needs a package"
    }
