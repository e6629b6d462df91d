"""Reads the grades to export: those of a batch, or the single one that `course check --json` wrote."""

from __future__ import annotations

import json
from collections.abc import Sequence
from datetime import datetime, timezone
from pathlib import Path

from autograder.classroom.batch.records import GRADES
from autograder.classroom.export.published import UnusableBatch
from autograder.engine.verdict import Grade


def read_batch(source: Path) -> tuple[Sequence[Grade], datetime]:
    """Return the grades in a folder's grades.json, or in the JSON file given, and when they were written.

    Raises:
        UnusableBatch: there are none, or the file is another one.
    """
    path = source / GRADES if source.is_dir() or source.suffix != ".json" else source
    try:
        records = json.loads(path.read_text(encoding="utf-8"))
        grades = [Grade.from_json(record) for record in (records if isinstance(records, list) else [records])]
        written = datetime.fromtimestamp(path.stat().st_mtime, timezone.utc)
    except FileNotFoundError as error:
        raise UnusableBatch(
            f"there is no {path}; grade first (./course grade SUBMITTED --out {path.parent}), or name the folder: "
            "--from FOLDER"
        ) from error
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise UnusableBatch(
            f"{path} does not hold the grades of a batch: {type(error).__name__}: {error}"
        ) from error
    if not grades:
        raise UnusableBatch(f"{path} has no grades; expected those of at least one submission")
    return grades, written
