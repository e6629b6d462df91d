"""Builds the site: copies the project's pages into one folder of sources, from which Sphinx makes HTML."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from collections.abc import Iterable, Mapping
from pathlib import Path, PurePosixPath

import nbformat
from nbformat import NotebookNode

from autograder.classroom.book.links import Links
from autograder.classroom.book.reader_copy import reader_copy
from ros_runtime.course_error import CommandFailed
from ros_runtime.project import PROJECT

CONFIGURATION = Path(__file__).with_name("sphinx")
PARTS = {
    "Chapters": ("chapters/*.ipynb",),
    "Exercises": ("exercises/*/*.ipynb",),
    "Look it up": ("docs/glossary.md", "docs/cheat_sheet.md", "docs/ros2_commands.md", "docs/robot.md"),
    "Set it up": ("docs/for_students.md", "docs/any_machine.md", "docs/accessibility.md"),
    "For instructors": (
        "docs/choosing.md",
        "docs/for_instructors.md",
        "docs/jupyterhub.md",
        "docs/grading.md",
        "docs/clusters.md",
        "docs/recordings.md",
        "docs/exports.md",
        "docs/from_github_classroom.md",
        "docs/write_an_exercise.md",
        "docs/coverage.md",
        "docs/architecture.md",
    ),
}
WEEK_PAGES = "One page a week"
# This page is the README of the students' archive, so its links and pictures are relative to the top folder.
MOVED = {"docs/for_students.md": "README.md"}
PICTURES = ("chapters/images", "docs/images")
WELCOME = """\
# ROS 2 services and actions on a humanoid

A humanoid keeps its own balance, walks when a node commands it, and falls when a node fails. The chapters show on this
robot what goes wrong between ROS 2 programs, and how to do it right.{outputs}

![The humanoid in three phases of a step](docs/images/robot.png)

**Predict** before you read on: the replies to each choice are folded. In the lab you have a robot of your own, and you
run every cell and change it.
"""
OUTPUTS = " Their outputs and pictures come from a run of every cell."
_DRAWING = re.compile(r"^!\[.*\]\(images/", re.MULTILINE)


def parts_of(project: Path) -> dict[str, dict[PurePosixPath, Path]]:
    """Return the pages of the book by part, in order: the path of each in the sources, and the file to copy."""
    return {
        part: {
            _place(path.relative_to(project)): path
            for pattern in patterns
            for path in sorted(project.glob(pattern))
        }
        for part, patterns in PARTS.items()
    }


def _place(path: Path) -> PurePosixPath:
    name = path.as_posix()
    return PurePosixPath(MOVED.get(name, name))


def make_site(
    output: Path, work: Path, runs: Mapping[str, NotebookNode | None], *, project: Path = PROJECT
) -> Path:
    """Make the site in `output`, with the chapters' `runs` by name, and return its first page.

    `work` is a folder for Sphinx's sources and cache.

    Raises CommandFailed, with the errors and warnings of Sphinx.
    """
    sources = work / "sources"
    shutil.rmtree(sources, ignore_errors=True)
    _gather(sources, runs, project)
    command = [
        *(sys.executable, "-m", "sphinx", "--builder", "html", "--quiet", "--jobs", "auto"),
        *("--fail-on-warning", "--conf-dir", str(CONFIGURATION), "--doctree-dir", str(work / "doctrees")),
        *(str(sources), str(output)),
    ]
    finished = subprocess.run(command, capture_output=True, text=True, cwd=PROJECT)
    if finished.returncode != 0:
        raise CommandFailed(f"Sphinx could not make the book:\n{finished.stderr.strip()}")
    return output / "index.html"


def _gather(sources: Path, runs: Mapping[str, NotebookNode | None], project: Path) -> None:
    parts = parts_of(project)
    pages = {page: file for part in parts.values() for page, file in part.items()}
    week_pages = []
    for page, file in pages.items():
        (sources / page).parent.mkdir(parents=True, exist_ok=True)
        links = Links(page, pages)
        if page.suffix == ".ipynb":
            notebook = nbformat.read(file, as_version=4)
            nbformat.write(reader_copy(notebook, runs.get(page.stem), links), sources / page)
            if text := week_page(notebook):
                week_pages.append(page.with_name(f"week_{page.stem}.md"))
                (sources / week_pages[-1]).write_text(links.rewritten(text), encoding="utf-8")
        else:
            text = file.read_text(encoding="utf-8")
            (sources / page).write_text(links.rewritten(text), encoding="utf-8")
    for folder in PICTURES:
        if (project / folder).is_dir():
            shutil.copytree(project / folder, sources / folder)
    tables = {**parts, WEEK_PAGES: week_pages}
    contents = "\n".join(_table_of_contents(part, pages) for part, pages in tables.items() if pages)
    welcome = WELCOME.format(outputs=OUTPUTS if runs else "")
    (sources / "index.md").write_text(f"{welcome}\n{contents}", encoding="utf-8")


def _table_of_contents(part: str, pages: Iterable[PurePosixPath]) -> str:
    entries = "\n".join(page.with_suffix("").as_posix() for page in pages)
    return f"```{{toctree}}\n:caption: {part}\n:maxdepth: 1\n\n{entries}\n```\n"


def week_page(notebook: NotebookNode) -> str | None:
    """Return a chapter's page as Markdown, with links relative to the chapter, or None if it has no drawing."""
    texts = {cell.id: cell.source for cell in notebook.cells if cell.cell_type == "markdown"}
    drawn = [text for text in (texts.get("diagram", ""), *texts.values()) if _DRAWING.search(text)]
    if not drawn:
        return None
    title, *paragraphs = texts["title"].split("\n\n")
    outcomes = (text for text in paragraphs if text.startswith(("**After", "- ")))
    drawing = next(line for line in drawn[0].splitlines() if _DRAWING.match(line))
    _, _, conventions = texts.get("conventions", "").partition("\n\n")
    table = conventions.split("\n\n")[0]
    return "\n\n".join(part for part in (title, *outcomes, drawing, table) if part) + "\n"
