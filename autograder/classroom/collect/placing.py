"""Writes the chosen files to submitted/<student>/<exercise>/; overwrites different work only with --overwrite."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from autograder.atomic_file import write_atomically
from autograder.classroom.collect.choice import Choice
from autograder.classroom.collect.download import Refused
from autograder.engine.exercise import submission_names
from autograder.engine.submission import most_bytes

TIMESTAMP = "timestamp.txt"


@dataclass
class Placed:
    """The submissions written or unchanged, by student and exercise, and a sentence on each that was refused."""

    written: list[tuple[str, str]] = field(default_factory=list)
    unchanged: list[tuple[str, str]] = field(default_factory=list)
    refused: list[str] = field(default_factory=list)


def place(choice: Choice, out: Path, *, overwrite: bool) -> Placed:
    """Write each submission completely, or not at all if one of its files cannot be read."""
    placed = Placed()
    for (student, exercise), work in sorted(choice.works.items()):
        folder = out / student / exercise
        try:
            contents = {name: file.read(most_bytes(name)) for name, file in work.files.items()}
        except Refused as error:
            placed.refused.append(f"{student}'s {exercise}: {error}")
            continue
        if folder.is_symlink() or folder.parent.is_symlink() or (folder.exists() and not folder.is_dir()):
            placed.refused.append(f"{student}'s {exercise}: {folder} is a link or not a folder; move it away")
            continue
        before = _existing_files(folder, exercise)
        if before == contents:
            placed.unchanged.append((student, exercise))
        elif before and not overwrite:
            placed.refused.append(
                f"{student}'s {exercise}: {folder} holds other work; --overwrite replaces it, another --out keeps both"
            )
        else:
            _write(folder, contents, before, choice.timestamps[student, exercise])
            placed.written.append((student, exercise))
    return placed


def _existing_files(folder: Path, exercise: str) -> dict[str, bytes | None]:
    """Return the content of the files that a grader would read in the folder; None for a link or a folder."""
    places = [folder / name for name in submission_names(exercise)]
    return {
        path.name: path.read_bytes() if path.is_file() and not path.is_symlink() else None
        for path in places
        if path.exists() or path.is_symlink()
    }


def _write(
    folder: Path,
    contents: Mapping[str, bytes],
    before: Mapping[str, bytes | None],
    timestamp: str,
) -> None:
    for name in before.keys() - contents.keys():
        (folder / name).unlink()
    for name, content in contents.items():
        write_atomically(folder / name, content)
    (folder / TIMESTAMP).unlink(missing_ok=True)
    if timestamp:
        write_atomically(folder / TIMESTAMP, f"{timestamp}\n")
