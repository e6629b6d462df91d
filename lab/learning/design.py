"""Draws a student's design and lists its missing facts."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from IPython.display import HTML

from lab.errors import LabError
from ros_runtime.design import EXAMPLE, Design, read_design
from ros_runtime.drawing.design_graph import design_svg
from ros_runtime.self_checks import store_check

FACTS_OF_A_LINK = 6
MAX_FILE_SIZE = 1_000_000  # bytes
NEEDS = re.compile(r"\bneeds?:?((?:\d|,|\s|and)+)")  # in a comment: "need 4", "needs 8, 10", "needs 1 and 2"


def draw_design(file: str | Path, title: str = "") -> HTML:
    """Draw the nodes and links that a file describes; a link that lacks a fact is drawn red and dashed.

    Raises LabError when the file cannot be read, or has no link.
    """
    design = read_design(_text(Path(file)))
    if not design.links:
        raise LabError(f"{file} has no link yet; a link begins with a line such as {EXAMPLE!r}")
    return HTML(design_svg(design, title=title or f"The design in {file}"))


def check_design(file: str | Path, links: int = 1, needs: int = 0) -> None:
    """Print which facts each link lacks, whether there are at least `links` links, and which needs no comment names.

    The needs are 1 to `needs`, or to the highest number that a comment such as `# need 4` beside a link names. Only
    the presence of a fact or comment is checked: it may still be wrong.

    Raises LabError when the file cannot be read.
    """
    path = Path(file)
    text = _text(path)
    design = read_design(text)
    sentences = [*_what_is_missing(design, links), *_what_is_not_served(text, needs)]
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


def _what_is_not_served(text: str, needs: int) -> Iterator[str]:
    """Name the needs that no comment beside a link names; a comment in a line of its own does not count."""
    lines = [line.partition("#") for line in text.splitlines()]
    lists = [found[1] for words, _, comment in lines if words.strip() for found in NEEDS.finditer(comment)]
    named = {int(number) for numbers in lists for number in re.findall(r"\b\d{1,2}\b", numbers)}
    unnamed = [str(need) for need in range(1, max(named | {needs}) + 1) if need not in named]
    if unnamed:
        yield f"no comment beside a link names the need{'' if len(unnamed) == 1 else 's'} {', '.join(unnamed)}"


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}{'' if number == 1 else 's'}"


def _text(path: Path) -> str:
    try:
        if path.stat().st_size > MAX_FILE_SIZE:
            raise LabError(f"{path} has more than {MAX_FILE_SIZE} bytes; a design should be a page of text")
        return path.read_text(encoding="utf-8-sig")
    except FileNotFoundError:
        raise LabError(f"there is no file {path}; run the cell that begins %%writefile {path.name}") from None
    except (OSError, UnicodeDecodeError) as error:
        raise LabError(f"{path} cannot be read: {error}") from error
