"""The start pages link to every notebook, and no link between notebooks is broken."""

from __future__ import annotations

import re
from pathlib import Path

import nbformat
import pytest

ROOT = Path(__file__).resolve().parents[3]
FIRST_PAGE = ROOT / "start_here.ipynb"  # shows progress, when its cell is run
START_PAGE = ROOT / "chapters/README.md"
NOTEBOOKS = [
    path
    for folder in ("chapters", "exercises", "solutions")
    for path in sorted((ROOT / folder).rglob("*.ipynb"))
    if ".ipynb_checkpoints" not in path.parts
]


def linked_from(page: Path) -> set[Path]:
    """The files that a page or the markdown of a notebook links to or shows."""
    text = page.read_text()
    if page.suffix == ".ipynb":
        cells = nbformat.reads(text, as_version=4).cells
        text = "\n".join(cell.source for cell in cells if cell.cell_type == "markdown")
    links = re.findall(r"\]\(([^)\s]+)\)", text)
    return {(page.parent / link).resolve() for link in links if not re.match(r"https?:|#", link)}


def test_the_first_page_leads_to_the_list_and_to_chapter_1() -> None:
    assert {START_PAGE, ROOT / "chapters/01_robot_and_graph.ipynb"} <= linked_from(FIRST_PAGE)


def test_it_leads_to_every_chapter_and_every_exercise() -> None:
    wanted = {path for path in NOTEBOOKS if not path.is_relative_to(ROOT / "solutions")}
    assert {path.relative_to(ROOT).as_posix() for path in wanted - linked_from(START_PAGE)} == set()


@pytest.mark.parametrize("page", [FIRST_PAGE, START_PAGE, *NOTEBOOKS], ids=lambda page: page.stem)
def test_its_links_lead_somewhere(page: Path) -> None:
    assert [link for link in linked_from(page) if not link.exists()] == []
