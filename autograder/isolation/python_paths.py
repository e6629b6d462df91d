"""Which host paths a sandbox must show so that this interpreter runs inside it."""

from __future__ import annotations

import os
import sys
from pathlib import Path

_ALWAYS_SHOWN = ("/usr", "/bin", "/lib", "/lib64")


def python_read_only_paths() -> list[Path]:
    """Return the folders of this interpreter: the virtual environment and the Python it was made from.

    /usr and the libraries are in every sandbox and left out. An editable install's project folder is left out
    too: callers name the packages they want to show.
    """
    folders = {
        sys.prefix,
        sys.base_prefix,
        sys.exec_prefix,
        sys.base_exec_prefix,
        *_along_links(sys.executable),
    }
    folders |= {os.path.realpath(folder) for folder in folders}
    shown = sorted(folder for folder in folders if not _is_below(folder, _ALWAYS_SHOWN))
    return [
        Path(folder)
        for folder in shown
        if not _is_below(folder, [other for other in shown if other != folder])
    ]


def _along_links(program: str) -> list[str]:
    """Return the folder above bin of each program on the way from a virtual environment to the real one."""
    folders = [os.path.dirname(os.path.dirname(program))]
    while os.path.islink(program):
        program = os.path.join(os.path.dirname(program), os.readlink(program))
        folders.append(os.path.dirname(os.path.dirname(os.path.normpath(program))))
    return folders


def _is_below(path: str, folders: list[str] | tuple[str, ...]) -> bool:
    return any(path == folder or path.startswith(folder.rstrip("/") + "/") for folder in folders)
