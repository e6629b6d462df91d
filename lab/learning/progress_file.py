"""What you have done in the chapters, in a file beside the notebooks: it outlives the kernel."""

from __future__ import annotations

import json
from pathlib import Path
from random import randrange
from typing import Literal

FILE = Path(".progress.json")  # hidden, as the files of tools are
Kind = Literal["predictions", "questions", "gaps"]


def kept(kind: Kind, folder: Path = Path()) -> dict[str, str]:
    """Return what was kept of one kind in a folder: a question's chosen answer, or when a file's gap was filled."""
    entries = _read(folder / FILE).get(kind)
    return entries if isinstance(entries, dict) else {}


def keep(kind: Kind, key: str, value: str | None) -> None:
    """Write down a value under its key, or forget it when there is none."""
    entries = kept(kind)
    entries.pop(key, None)
    if value is not None:
        entries[key] = value
    _write({**_read(FILE), kind: entries})


def own_number() -> int:
    """Return a number that was drawn once for the notebooks of this folder: yours differs from other students'."""
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
    except (FileNotFoundError, ValueError):  # after damage each question is only asked again
        return {}
    return progress if isinstance(progress, dict) else {}
