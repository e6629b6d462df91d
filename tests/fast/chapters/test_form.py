"""What holds for every chapter as it is stored: its parts, its cells and its drawings."""

from __future__ import annotations

import ast
import re
from pathlib import Path

import nbformat
import pytest

from chapter_gaps import gaps_of
from lab.learning.gap import read_gaps
from lab.learning.gap_cells import fill, is_empty, is_python
from lab.learning.question import read_questions

CHAPTERS = Path(__file__).resolve().parents[3] / "chapters"
NAMES = sorted(path.stem for path in CHAPTERS.glob("*.ipynb"))
SHORT = {"12_design", "13_two_walkers"}  # no lessons of their own: a design, and an extra
LESSONS = [name for name in NAMES if name not in SHORT]
MOST_WORDS = 2000  # between two tasks; a quarter of an hour at 130 words a minute


def read(name: str) -> nbformat.NotebookNode:
    return nbformat.read(CHAPTERS / f"{name}.ipynb", as_version=4)


def markdown(name: str) -> str:
    return "\n".join(cell.source for cell in read(name).cells if cell.cell_type == "markdown")


def test_there_are_chapters() -> None:
    assert [name.partition("_")[0] for name in NAMES] == [
        "01",
        "02",
        "03",
        "03b",
        "04",
        "05",
        "06",
        "07",
        "08",
        "09",
        "10",
        "11",
        "12",
        "13",
    ]


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
def test_its_first_cell_gives_its_programs_a_folder_of_their_own(name: str) -> None:
    first = next(cell.source for cell in read(name).cells if cell.cell_type == "code")
    assert f'lab.keep_programs_in("programs/{name}")' in first


@pytest.mark.parametrize("name", LESSONS)
def test_it_has_the_parts_of_a_lesson(name: str) -> None:
    text = markdown(name)
    for part in (
        "## Break it",
        "## Fix it",
        "## Pitfall",
        "expects of you",
        "./course check",
    ):
        assert part in text, part


@pytest.mark.parametrize("name", NAMES)
def test_it_has_the_parts_of_a_chapter(name: str) -> None:
    text = markdown(name)
    for part in (
        "After this chapter you can",
        "## Why",
        "**Predict",
        "## Quiz",
        "## Your turn",
        "## What comes next",
    ):
        assert part in text, part


@pytest.mark.parametrize("name", NAMES)
def test_there_is_something_to_do_every_quarter_of_an_hour(name: str) -> None:
    words = 0
    for cell in read(name).cells:
        words = 0 if cell.cell_type == "code" else words + len(cell.source.split())
        assert words < MOST_WORDS, cell.id


@pytest.mark.parametrize("name", NAMES)
def test_each_prediction_is_asked_for_then_required_then_answered(name: str) -> None:
    chapter = name.partition("_")[2]
    predictions = read_questions(chapter, "predictions")
    assert len(predictions) >= (4 if name in LESSONS else 2)
    lines = "\n".join(cell.source for cell in read(name).cells if cell.cell_type == "code").splitlines()
    said = [line for line in lines if "prediction_" in line]
    assert said == [
        line
        for number in range(1, len(predictions) + 1)
        for line in (
            f'prediction_{number} = lab.predict("{chapter}", {number})',
            f"prediction_{number}",
            f"prediction_{number}.require()",
            f"prediction_{number}.reply()",
        )
    ]


@pytest.mark.parametrize("name", NAMES)
def test_no_text_stands_between_a_prediction_and_its_reply(name: str) -> None:
    # the lab shows the text below a reply only when the reply has run (course.js), as it tells the outcome
    is_open = False
    for cell in read(name).cells:
        is_open |= "= lab.predict(" in cell.source
        is_open &= ".reply()" not in cell.source
        assert not (is_open and cell.cell_type == "markdown"), cell.id


@pytest.mark.parametrize("name", NAMES)
def test_an_experiment_begins_with_its_prediction(name: str) -> None:
    waiting = [cell.source for cell in read(name).cells if ".require()" in cell.source]
    assert all(source.splitlines()[0].endswith(".require()") for source in waiting)


@pytest.mark.parametrize("name", NAMES)
def test_no_cell_needs_an_import_of_an_experiment_that_waits_for_its_prediction(name: str) -> None:
    waiting: set[str] = set()
    known: set[str] = set()
    for cell in read(name).cells:
        if cell.cell_type != "code" or cell.source.startswith("%%"):
            continue
        program = re.sub(r"^(\s*)!.*", r"\1pass", cell.source, flags=re.MULTILINE)
        nodes = list(ast.walk(ast.parse(program)))
        imports = [node for node in nodes if isinstance(node, ast.Import | ast.ImportFrom)]
        imported = {alias.asname or alias.name.partition(".")[0] for node in imports for alias in node.names}
        used = {node.id for node in nodes if isinstance(node, ast.Name)}
        assert used & waiting <= known | imported, cell.id
        if ".require()" in cell.source:
            waiting |= imported
        else:
            known |= imported


@pytest.mark.parametrize("name", NAMES)
def test_no_quiz_question_is_stored_with_an_answer(name: str) -> None:
    assert not [cell.id for cell in read(name).cells if re.search(r"question_\d+\.answer", cell.source)]


@pytest.mark.parametrize("name", NAMES)
def test_every_drawing_exists_and_has_an_alternative_text(name: str) -> None:
    images = re.findall(r"!\[(.*?)\]\((.*?)\)", markdown(name), re.DOTALL)
    assert images
    for alternative, path in images:
        assert len(alternative) > 40, path
        assert "<title>" in (CHAPTERS / path).read_text()


@pytest.mark.parametrize("name", NAMES)
def test_its_gaps_are_empty_and_their_folded_solutions_are_a_few_lines(name: str) -> None:
    gaps = gaps_of(read(name))
    assert list(gaps) == [gap.file for gap in read_gaps(name.partition("_")[2])]
    for file, (program, solution) in gaps.items():
        assert is_empty(program), file
        assert not is_empty(fill(program, solution)), file
        assert 3 <= len(solution.splitlines()) <= 8, file
        if is_python(file):
            compile(fill(program, solution), file, "exec")
