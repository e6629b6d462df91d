"""Follows a page of the documentation like a reader: runs its commands, writes its files, fills its cells."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import nbformat

_BLOCK = re.compile(r"^```(\w+)(?: (file|cell)=(\S+))?\n(.*?)^```$", re.MULTILINE | re.DOTALL)


class Step(NamedTuple):
    """A fenced block: commands (`sh`), or the content of a file or of a notebook's cell."""

    language: str
    where: str
    place: str
    text: str


def steps(page: Path) -> Iterator[Step]:
    """The blocks of a page, in order."""
    for match in _BLOCK.finditer(page.read_text(encoding="utf-8")):
        yield Step(match[1], match[2] or "", match[3] or "", match[4])


def carry_out(step: Step, folder: Path, notebook: Path) -> str:
    """Execute a block in a folder; return the output of its commands. A failing command raises an AssertionError."""
    if step.where == "file":
        (folder / step.place).write_text(step.text, encoding="utf-8")
    elif step.where == "cell":
        content = nbformat.read(notebook, as_version=4)
        next(cell for cell in content.cells if cell.id == step.place).source = step.text.rstrip("\n")
        nbformat.write(content, notebook)
    elif step.language == "sh":
        ran = subprocess.run(
            ["bash", "-e", "-c", step.text],
            cwd=folder,
            capture_output=True,
            text=True,
            check=False,
            timeout=300,
        )
        assert ran.returncode == 0, f"{step.text}\n{ran.stdout}\n{ran.stderr}"
        return ran.stdout
    return ""
