"""Creates an exercise from the templates of its kind: notebook, scenarios, checks, known submissions."""

from __future__ import annotations

import keyword
import re
from pathlib import Path

import nbformat
from jinja2 import Environment, FileSystemLoader, StrictUndefined
from nbformat import NotebookNode
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

from autograder.classroom.nbgrader_bridge.generated_cells import cell_metadata
from ros_runtime.course_error import CourseError

KINDS_FOLDER = Path(__file__).with_name("kinds")
KINDS = tuple(sorted(folder.name for folder in KINDS_FOLDER.iterdir()))
_TEMPLATE = ".j2"
_NAME = re.compile(r"[a-z][a-z0-9_]*")
# The notebook is made from both templates, and the correct submission from the solution.
_SOLUTION, _TASK = f"solution.py{_TEMPLATE}", f"task.md{_TEMPLATE}"
_MARKS = re.compile(r"^ *### (BEGIN|END) SOLUTION\n", re.MULTILINE)


def make_exercise(name: str, kind: str, course: Path) -> Path:
    """Create `course`/`name`/, an exercise of one of KINDS, and return that folder.

    Raises `CourseError` if the name is invalid or the folder exists.
    """
    if not _NAME.fullmatch(name) or keyword.iskeyword(name):
        raise CourseError(
            f"{name!r} cannot be an exercise's name: use small letters, digits and _, as in battery_service"
        )
    folder = course / name
    if folder.exists():
        raise CourseError(f"{folder} exists already; choose another name, or remove the folder")
    words = {"name": name, "title": name.replace("_", " ").capitalize(), "type_name": _type_name(name)}
    templates = Environment(
        loader=FileSystemLoader(KINDS_FOLDER / kind), undefined=StrictUndefined, keep_trailing_newline=True
    )
    texts = {place: templates.get_template(place).render(words) for place in templates.list_templates()}
    solution, task = texts.pop(_SOLUTION), texts.pop(_TASK)
    texts[f"known/correct/plain.py{_TEMPLATE}"] = (
        f'"""Style: as in the notebook."""\n{_MARKS.sub("", solution)}'
    )
    for place, text in texts.items():
        path = folder / place.removesuffix(_TEMPLATE)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    nbformat.write(_notebook(words, task, solution), folder / f"{name}.ipynb")
    return folder


def _type_name(name: str) -> str:
    return "".join(word.capitalize() for word in name.split("_"))


def _notebook(words: dict[str, str], task: str, solution: str) -> NotebookNode:
    """Return the source notebook without grade cells, which `release --exercises` generates from the checks."""
    name = words["name"]
    cells = [
        new_markdown_cell(f"# {words['title']}", id="title"),
        new_markdown_cell(f"## The task\n\n{task.strip()}", id="task", metadata=cell_metadata("task")),
        new_markdown_cell(
            f"## Your solution\n\nRun the cell: it writes `{name}.py`. Then check it below.",
            id="solution-intro",
        ),
        new_code_cell(
            f"%%writefile {name}.py\n{solution.strip()}",
            id="solution",
            metadata=cell_metadata("solution", solution=True),
        ),
        new_markdown_cell(
            "## Check it\n\nRun the visible checks; each failed check says what to do next.",
            id="self-check-intro",
        ),
        new_code_cell(
            f'from autograder.self_check import self_check\n\nchecked = self_check("{name}")', id="self-check"
        ),
    ]
    kernel = {"display_name": "Python 3 (ipykernel)", "language": "python", "name": "python3"}
    return new_notebook(cells=cells, metadata={"kernelspec": kernel})
