"""Draws a student's design and lists its missing facts."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from IPython.display import HTML

from lab.errors import LabError
from ros_runtime.design import EXAMPLE, Design, read_design
from ros_runtime.drawing.design_graph import design_svg
from ros_runtime.self_checks import store_check

FACTS_OF_A_LINK = 6
MAX_FILE_SIZE = 1_000_000  # bytes


def draw_design(file: str | Path, title: str = "") -> HTML:
    """Draw the nodes and links that a file describes; a link that lacks a fact is drawn red and dashed.

    Raises LabError when the file cannot be read, or has no link.
    """
    design = _read(Path(file))
    if not design.links:
        raise LabError(f"{file} has no link yet; a link begins with a line such as {EXAMPLE!r}")
    return HTML(design_svg(design, title=title or f"The design in {file}"))


def check_design(file: str | Path, links: int = 1) -> None:
    """Print which facts each link lacks, and whether there are at least `links` links.

    Only the presence of a fact is checked: a fact may still be wrong.

    Raises LabError when the file cannot be read.
    """
    path = Path(file)
    design = _read(path)
    sentences = list(_what_is_missing(design, links))
    given = sum(FACTS_OF_A_LINK - len(link.missing()) for link in design.links)
    store_check(path.stem, given, FACTS_OF_A_LINK * max(links, len(design.links)))
    print(f"{path}: {_count(len(design.nodes), 'node')}, {_count(len(design.links), 'link')}")
    for sentence in sentences:
        print(f"  {sentence}")
    if not sentences:
        print(
            "  Every link has all six facts. Whether they are right is not checked here: your instructor marks that."
        )


def _what_is_missing(design: Design, links: int) -> Iterator[str]:
    yield from design.problems
    for link in design.links:
        yield from (f"{link}: {sentence}" for sentence in link.missing())
    if len(design.links) < links:
        yield f"the task asks for at least {_count(links, 'link')}"


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}{'' if number == 1 else 's'}"


def _read(path: Path) -> Design:
    try:
        if path.stat().st_size > MAX_FILE_SIZE:
            raise LabError(f"{path} has more than {MAX_FILE_SIZE} bytes; a design should be a page of text")
        return read_design(path.read_text(encoding="utf-8-sig"))
    except FileNotFoundError:
        raise LabError(f"there is no file {path}; run the cell that begins %%writefile {path.name}") from None
    except (OSError, UnicodeDecodeError) as error:
        raise LabError(f"{path} cannot be read: {error}") from error
