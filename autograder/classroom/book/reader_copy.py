"""Makes the book's copy of a notebook, with the outputs of a run and without buttons."""

from __future__ import annotations

import re
from collections.abc import Iterator

import nbformat
from nbformat import NotebookNode
from nbformat.v4 import new_markdown_cell, new_output

from autograder.classroom.book.links import Links
from autograder.classroom.book.still_widgets import VIEW, Models, models_of, prediction, quiz, replies, still
from lab.learning.progress_file import Kind
from lab.learning.question import Question, read_question

ASKS = re.compile(r'(?P<name>\w+) = lab\.(?P<way>predict|quiz)\("(?P<chapter>\w+)", (?P<number>\d+)\)')
KINDS: dict[str, Kind] = {"predict": "predictions", "quiz": "questions"}
REPLIES = re.compile(r"^(?P<name>\w+)\.reply\(\)$")
REQUIRES = re.compile(r"^\w+\.require\(\)\n+")
HIDDEN_INPUT = "remove-input"  # the tag with which myst-nb hides a cell's code


def reader_copy(notebook: NotebookNode, run: NotebookNode | None, links: Links) -> NotebookNode:
    """Return a copy for the book; `run` is the executed notebook, which may have additional cells, or None.

    Each cell has an anchor, so that links can name it by its id.
    """
    copy = nbformat.from_dict(notebook)
    outputs = {cell.id: cell.outputs for cell in run.cells if cell.cell_type == "code"} if run else {}
    models = models_of(run) if run else {}
    asked: dict[str, tuple[int, Question]] = {}
    copy.cells = [
        shown
        for number, cell in enumerate(notebook.cells)
        for shown in _shown(cell, outputs.get(cell.id, []), models, asked, links, anchored=number > 0)
    ]
    copy.metadata.pop("widgets", None)
    return copy


def _shown(
    cell: NotebookNode,
    outputs: list[NotebookNode],
    models: Models,
    asked: dict[str, tuple[int, Question]],
    links: Links,
    *,
    anchored: bool,
) -> Iterator[NotebookNode]:
    """Yield the cells that replace one cell in the book; the first has no anchor, because it is the page's heading."""
    anchor = f'<span id="{cell.id}"></span>'
    if cell.cell_type != "code":
        text = links.rewritten(cell.source)
        yield _changed(cell, source=f"{anchor}\n\n{text}" if anchored else text)
        return
    if anchored:
        yield new_markdown_cell(anchor)
    if asks := ASKS.match(cell.source):
        number = int(asks["number"])
        question = read_question(asks["chapter"], KINDS[asks["way"]], number)
        asked[asks["name"]] = number, question
        draw = prediction if asks["way"] == "predict" else quiz
        yield _with_html(cell, draw(number, question))
    elif (reply := REPLIES.match(cell.source)) and reply["name"] in asked:
        yield _with_html(cell, replies(*asked[reply["name"]]))
    else:
        yield _changed(
            cell,
            source=REQUIRES.sub("", cell.source),
            outputs=[_still(output, models) for output in outputs],
        )


def _with_html(cell: NotebookNode, html: str) -> NotebookNode:
    """Return the cell with this HTML instead of its code."""
    shown = _changed(cell, outputs=[_html(html)])
    shown.metadata = nbformat.from_dict({"tags": [HIDDEN_INPUT]})
    return shown


def _still(output: NotebookNode, models: Models) -> NotebookNode:
    view = output.get("data", {}).get(VIEW)
    return _html(still(view["model_id"], models)) if view else output


def _html(html: str) -> NotebookNode:
    return new_output("display_data", {"text/html": html})


def _changed(cell: NotebookNode, **changes: object) -> NotebookNode:
    return nbformat.from_dict({**cell, **changes})
