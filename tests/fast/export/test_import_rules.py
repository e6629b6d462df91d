"""The packages collect, export and on_gradescope import only what docs/architecture.md allows."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

GRADER = Path(__file__).resolve().parents[3] / "autograder"
MAY_IMPORT = {
    "collect": {"atomic_file", "batch", "collect", "engine"},
    "export": {"atomic_file", "batch", "engine", "export", "report"},
    "on_gradescope": {"atomic_file", "batch", "engine", "export", "isolation", "on_gradescope"},
}


def imported(file: Path) -> set[str]:
    """The packages of the grader from which a file imports."""
    nodes = list(ast.walk(ast.parse(file.read_text())))
    modules = [node.module or "" for node in nodes if isinstance(node, ast.ImportFrom)]
    modules += [alias.name for node in nodes if isinstance(node, ast.Import) for alias in node.names]
    rooms = [module.removeprefix("autograder.classroom.").removeprefix("autograder.") for module in modules]
    return {room.split(".")[0] for room, module in zip(rooms, modules, strict=True) if room != module}


@pytest.mark.parametrize("room", MAY_IMPORT)
def test_a_package_imports_only_what_it_may(room: str) -> None:
    files = sorted((GRADER / "classroom" / room).glob("*.py"))
    assert len(files) > 2
    assert {file.name: sorted(found) for file in files if (found := imported(file) - MAY_IMPORT[room])} == {}


def test_the_architecture_page_lists_the_same_imports() -> None:
    page = (GRADER.parent / "docs/architecture.md").read_text()
    for room, may in MAY_IMPORT.items():
        (row,) = [line for line in page.splitlines() if line.startswith(f"| · · `{room}/`")]
        said = {word.strip("` ") for word in row.rstrip("| ").rpartition("|")[2].split(",")}
        assert said == may - {"atomic_file", room}
