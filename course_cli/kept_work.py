"""Copies of a student's notebooks, which bring them back after a newer archive was unpacked over them."""

from __future__ import annotations

import hashlib
import json
import shutil
from pathlib import Path
from typing import Any

from ros_runtime.project import COURSE, PROJECT
from ros_runtime.self_checks import read_progress_file

ORIGINALS = PROJECT / "originals.json"  # of a student's copy: the SHA-256 of each notebook as it was released
KEPT = ".kept"  # hidden folder of the copies
NEWER = "newer"  # folder of new versions of notebooks that the student has changed


def keep_work(course: Path = COURSE, originals: Path = ORIGINALS) -> list[str]:
    """Copy each notebook that the student has changed; put the copy back where an archive has replaced the notebook.

    If the release changed such a notebook, too, the archive's version goes to the folder `newer`.

    Returns:
        sentences on the notebooks that were put back.
    """
    released = json.loads(originals.read_text(encoding="utf-8"))
    state = course / KEPT / originals.name
    stored = read_progress_file(state)  # {} at first, and if the file is damaged
    before = stored or released
    sentences = []
    for name, now in released.items():
        notebook, copy = course / name, course / KEPT / name
        if not notebook.exists():
            continue
        if sha256_of(notebook) != now:
            _copy(notebook, copy)
        elif copy.exists():
            sentences.append(
                f"an archive had replaced {name}: it is as you left it (to begin anew, delete {KEPT}/{name})"
            )
            if before.get(name) != now:
                _copy(notebook, course / NEWER / name)
                sentences.append(f"the archive's new version of it is {NEWER}/{name}")
            _copy(copy, notebook)
    if stored != released:
        _copy(originals, state)
    return sentences


def _jupyter_server_extension_points() -> list[dict[str, str]]:
    return [{"module": __name__}]


def _load_jupyter_server_extension(server: Any) -> None:
    """Copy each notebook that JupyterLab saves. As a setting, the hook would be validated twice, with a warning."""
    server.contents_manager.register_post_save_hook(keep_saved)


def keep_saved(os_path: str, **_: object) -> None:
    """Copy a notebook that JupyterLab has saved; a hook of its contents manager, called with keywords."""
    path = Path(os_path)
    if COURSE != PROJECT and path.suffix == ".ipynb" and path.is_relative_to(COURSE):
        _copy(path, COURSE / KEPT / path.relative_to(COURSE))


def sha256_of(path: Path) -> str:
    """Return the SHA-256 of a file, in hexadecimal digits."""
    return hashlib.sha256(path.read_bytes()).hexdigest()


def _copy(source: Path, target: Path) -> None:
    target.parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(source, target)
