"""Generates the students' notebooks from the source notebooks, with nbgrader's generate_assignment."""

from __future__ import annotations

import shutil
import tempfile
from pathlib import Path

import nbformat

from autograder.classroom.nbgrader_bridge.course_folder import call, open_course
from autograder.classroom.nbgrader_bridge.generated_cells import with_generated_cells
from autograder.classroom.nbgrader_bridge.source_notebook import read_source


def source_notebooks(solutions: Path) -> dict[str, Path]:
    """Return the source notebook of each exercise by its name: solutions/<exercise>/<exercise>.ipynb."""
    return {
        path.parent.name: path
        for path in sorted(solutions.glob("*/*.ipynb"))
        if path.stem == path.parent.name
    }


def out_of_date(solutions: Path, exercises: Path) -> list[Path]:
    """Return the notebooks that differ from what the checks and the source notebooks would generate."""
    return [path for path, content in _wanted(solutions, exercises).items() if _content(path) != content]


def bring_up_to_date(solutions: Path, exercises: Path) -> list[Path]:
    """Bring generated cells in solutions/ and all of exercises/ up to date; return the notebooks that have changed."""
    changed = []
    for path, content in _wanted(solutions, exercises).items():
        if _content(path) == content:
            continue
        changed.append(path)
        if content is None:
            path.unlink()
        else:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(content, encoding="utf-8")
    return changed


def generate_release(solutions: Path, exercises: Path) -> None:
    """Write exercises/<exercise>/<exercise>.ipynb for each source notebook; the same input gives the same bytes.

    Only notebooks are copied, because a source notebook that was run has written its solution beside itself.
    """
    with tempfile.TemporaryDirectory() as temporary:
        course = Path(temporary)
        for exercise, notebook in source_notebooks(solutions).items():
            place = course / "source" / exercise / notebook.name
            place.parent.mkdir(parents=True)
            nbformat.write(read_source(notebook), place)
            call(open_course(course, gradebook=False).generate_assignment, exercise)
            copy_notebook(course / "release" / exercise / notebook.name, exercises / exercise)


def _wanted(solutions: Path, exercises: Path) -> dict[Path, str | None]:
    """Return the content that each notebook should have; None if the notebook should not exist."""
    wanted: dict[Path, str | None] = dict.fromkeys(exercises.glob("*/*.ipynb"))
    with tempfile.TemporaryDirectory() as temporary:
        renewed, released = Path(temporary) / "solutions", Path(temporary) / "exercises"
        for exercise, notebook in source_notebooks(solutions).items():
            source = read_source(notebook)
            (renewed / exercise).mkdir(parents=True)
            nbformat.write(with_generated_cells(source, exercise), renewed / exercise / notebook.name)
        generate_release(renewed, released)
        for made, place in ((renewed, solutions), (released, exercises)):
            wanted |= {place / path.relative_to(made): _content(path) for path in made.rglob("*.ipynb")}
    return wanted


def _content(path: Path) -> str | None:
    return path.read_text(encoding="utf-8") if path.exists() else None


def copy_notebook(notebook: Path, folder: Path) -> None:
    """Copy a notebook into a folder, which is created if it is missing."""
    folder.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(notebook, folder / notebook.name)
