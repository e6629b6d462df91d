"""Finds gaps and their solutions in the cells of a chapter, and fills the gaps."""

from __future__ import annotations

import re
from textwrap import dedent, indent

import nbformat

MAGIC = "%%gap "
PLACEHOLDER = "raise NotImplementedError"
IN_A_DEFINITION = "..."  # the placeholder in .msg, .srv and .action files, and in .yaml files of parameters
_GAP = re.compile(
    rf"^(?P<indent> *)# YOUR CODE HERE.*\n(?: *#.*\n)*(?P=indent)(?:{PLACEHOLDER}.*|{re.escape(IN_A_DEFINITION)})\n",
    re.MULTILINE,
)
_PLACEHOLDER_LINE = re.compile(rf"^ *{PLACEHOLDER}\b", re.MULTILINE)
_SOLUTION = re.compile(r"<details>.*?```\w+\n(?P<lines>.*?)```.*?</details>", re.DOTALL)


def is_python(file: str) -> bool:
    """Whether the file of a gap is a Python program; otherwise it is an interface definition or a parameter file."""
    return file.endswith(".py")


def placeholder(file: str) -> str:
    """Return the placeholder line of an empty gap in this file."""
    return PLACEHOLDER if is_python(file) else IN_A_DEFINITION


def is_empty(program: str) -> bool:
    """Whether the gap still contains its placeholder; of a Python program, also without the comment above it."""
    return bool(_GAP.search(program) or _PLACEHOLDER_LINE.search(program))


def fill(program: str, lines: str) -> str:
    """Return the program with these lines in its gap, at the gap's indentation.

    Raises ValueError when it does not have exactly one gap.
    """
    if len(_GAP.findall(program)) != 1:
        raise ValueError(
            f"expected one gap, `# YOUR CODE HERE` with `{PLACEHOLDER}` or `{IN_A_DEFINITION}` after it:\n{program}"
        )
    return _GAP.sub(lambda gap: indent(dedent(lines), gap["indent"]), program)


def solution(text: str) -> str:
    """Return the lines of the folded solution, which is in the Markdown cell below a gap.

    Raises ValueError when the cell has no folded solution.
    """
    found = _SOLUTION.search(text)
    if not found:
        raise ValueError(f"expected a folded solution, <details> with a block of code, in:\n{text}")
    return found["lines"]


def fill_gaps(notebook: nbformat.NotebookNode) -> None:
    """Write the solutions into the gaps of a chapter."""
    for cell, below in zip(notebook.cells, notebook.cells[1:], strict=False):
        if cell.source.startswith(MAGIC):
            cell.source = fill(cell.source + "\n", solution(below.source))
