"""Chapters that were executed before: a second build is quick, and one that was interrupted goes on."""

from __future__ import annotations

import hashlib
from functools import cached_property
from pathlib import Path

import nbformat

# What a chapter's outputs come from, besides its own text.
ROOMS = ("humanoid_interfaces", "lab", "robot_sim", "ros_cli", "ros_runtime")
SOURCES = {".py", ".xml", ".msg", ".srv", ".action"}


class KeptRuns:
    """Executed notebooks in a folder, under a hash of the chapter and of the rooms that it runs."""

    def __init__(self, folder: Path, project: Path) -> None:
        self._folder = folder
        self._project = project

    def of(self, chapter: Path) -> nbformat.NotebookNode | None:
        """Return the chapter's run, or None when there is none of its present content."""
        kept = self._file(chapter)
        return nbformat.read(kept, as_version=4) if kept.exists() else None

    def keep(self, chapter: Path, executed: nbformat.NotebookNode) -> None:
        """Keep a run in place of the chapter's earlier ones; killed at any moment, it leaves no half file."""
        self._folder.mkdir(parents=True, exist_ok=True)
        kept = self._file(chapter)
        for earlier in self._folder.glob(f"{chapter.stem}-*.ipynb"):
            earlier.unlink()
        half = kept.with_suffix(".half")
        nbformat.write(executed, half)
        half.replace(kept)

    def _file(self, chapter: Path) -> Path:
        digest = hashlib.sha256(chapter.read_bytes() + self._rooms).hexdigest()
        return self._folder / f"{chapter.stem}-{digest[:16]}.ipynb"

    @cached_property
    def _rooms(self) -> bytes:
        digest = hashlib.sha256()
        for room in ROOMS:
            for path in sorted((self._project / room).rglob("*")):
                if path.suffix in SOURCES:
                    digest.update(f"{path.relative_to(self._project)}\n".encode() + path.read_bytes())
        return digest.digest()
