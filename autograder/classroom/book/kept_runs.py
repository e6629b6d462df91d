"""A cache of executed chapters, so that a second build is quick and an interrupted build can continue."""

from __future__ import annotations

import hashlib
from functools import cached_property
from pathlib import Path

import nbformat

# Folders that a chapter's outputs depend on, besides its own text.
SOURCE_FOLDERS = ("humanoid_interfaces", "lab", "robot_sim", "ros_cli", "ros_runtime")
SOURCES = {".py", ".xml", ".msg", ".srv", ".action"}


class KeptRuns:
    """Executed notebooks in a folder, named by a hash of the chapter and of the code that it runs."""

    def __init__(self, folder: Path, project: Path) -> None:
        self._folder = folder
        self._project = project

    def of(self, chapter: Path) -> nbformat.NotebookNode | None:
        """Return the stored run of the chapter's present content, or None."""
        kept = self._file(chapter)
        return nbformat.read(kept, as_version=4) if kept.exists() else None

    def keep(self, chapter: Path, executed: nbformat.NotebookNode) -> None:
        """Store a run and remove the chapter's earlier ones; the file is written atomically."""
        self._folder.mkdir(parents=True, exist_ok=True)
        kept = self._file(chapter)
        for earlier in self._folder.glob(f"{chapter.stem}-*.ipynb"):
            earlier.unlink()
        half = kept.with_suffix(".half")
        nbformat.write(executed, half)
        half.replace(kept)

    def _file(self, chapter: Path) -> Path:
        digest = hashlib.sha256(chapter.read_bytes() + self._sources_hash).hexdigest()
        return self._folder / f"{chapter.stem}-{digest[:16]}.ipynb"

    @cached_property
    def _sources_hash(self) -> bytes:
        digest = hashlib.sha256()
        for name in SOURCE_FOLDERS:
            for path in sorted((self._project / name).rglob("*")):
                if path.suffix in SOURCES:
                    digest.update(f"{path.relative_to(self._project)}\n".encode() + path.read_bytes())
        return digest.digest()
