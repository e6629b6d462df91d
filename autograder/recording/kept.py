"""Stores recordings on disk."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from autograder.atomic_file import write_atomically

FOLDER = "recordings"  # in the output of a batch: recordings/<student>/<exercise>/<scenario>.mcap
SUFFIX = ".mcap"

Recordings = Mapping[str, bytes]  # MCAP files by their names, such as walk.mcap


def keep(folder: Path, recordings: Recordings) -> None:
    """Write the recordings of one submission into its folder, and remove those of an earlier grading."""
    for old in folder.glob(f"*{SUFFIX}"):
        if old.name not in recordings:
            old.unlink()
    for name, content in recordings.items():
        write_atomically(folder / name, content)
