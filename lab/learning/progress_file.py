"""Stores the student's progress in the chapters in a file beside the notebooks, so that it outlives the kernel."""

from __future__ import annotations

import json
from pathlib import Path
from random import randrange
from typing import Literal

from lab.running.programs_folder import notebook_folder
from ros_runtime.self_checks import entries_of, read_progress_file

NAME = ".progress.json"  # hidden, like the files of other tools
Kind = Literal["predictions", "questions", "gaps"]


def read_entries(kind: Kind, folder: Path | None = None) -> dict[str, str]:
    """Return the entries of one kind, such as the chosen answers or the times at which gaps were filled.

    They are read from `folder`, by default the folder of the running notebook.
    """
    return entries_of((folder or notebook_folder()) / NAME, kind)


def store_entry(kind: Kind, key: str, value: str | None) -> None:
    """Store a value under its key; None deletes the key."""
    entries = read_entries(kind)
    entries.pop(key, None)
    if value is not None:
        entries[key] = value
    _write({**_read_all(), kind: entries})


def shuffle_seed() -> int:
    """Return a random number that is drawn once for this folder of notebooks, so it differs between students."""
    content = _read_all()
    if not isinstance(number := content.get("number"), int):
        number = randrange(10**9)
        _write({**content, "number": number})
    return number


def _read_all() -> dict:
    return read_progress_file(notebook_folder() / NAME)


def _write(content: dict) -> None:
    (notebook_folder() / NAME).write_text(
        json.dumps(content, indent=1, ensure_ascii=False) + "\n", encoding="utf-8"
    )
