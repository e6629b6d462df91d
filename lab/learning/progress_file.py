"""Stores the student's progress in the chapters in a file beside the notebooks, so that it outlives the kernel."""

from __future__ import annotations

import json
from pathlib import Path
from random import randrange
from typing import Literal

FILE = Path(".progress.json")  # hidden, as the files of tools are
Kind = Literal["predictions", "questions", "gaps"]


def kept(kind: Kind, folder: Path = Path()) -> dict[str, str]:
    """Return the stored entries of one kind in a folder, such as the chosen answers or the times of filled gaps."""
    entries = _read(folder / FILE).get(kind)
    return entries if isinstance(entries, dict) else {}


def keep(kind: Kind, key: str, value: str | None) -> None:
    """Store a value under its key; None deletes the key."""
    entries = kept(kind)
    entries.pop(key, None)
    if value is not None:
        entries[key] = value
    _write({**_read(FILE), kind: entries})


def own_number() -> int:
    """Return a random number that was drawn once for this folder of notebooks, so it differs between students."""
    everything = _read(FILE)
    if not isinstance(number := everything.get("number"), int):
        number = randrange(10**9)
        _write({**everything, "number": number})
    return number


def _write(everything: dict) -> None:
    FILE.write_text(json.dumps(everything, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


def _read(file: Path) -> dict:
    try:
        progress = json.loads(file.read_text(encoding="utf-8"))
    except (FileNotFoundError, ValueError):  # a damaged file only means that each question is asked again
        return {}
    return progress if isinstance(progress, dict) else {}
