"""Zip archives that are reproducible: the same content gives the same bytes."""

from __future__ import annotations

import stat
import zipfile
from collections.abc import Mapping
from pathlib import Path

_DATED = (2026, 1, 1, 0, 0, 0)


def write_archive(archive: Path, files: Mapping[str, Path | str]) -> None:
    """Write a zip; `files` maps paths in it to files, or to texts, which become executable scripts."""
    archive.parent.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as bundle:
        for name in sorted(files):
            source = files[name]
            entry = zipfile.ZipInfo(name, date_time=_DATED)
            runs = isinstance(source, str) or bool(source.stat().st_mode & stat.S_IXUSR)
            entry.external_attr = (stat.S_IFREG | (0o755 if runs else 0o644)) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            bundle.writestr(entry, source if isinstance(source, str) else source.read_bytes())
