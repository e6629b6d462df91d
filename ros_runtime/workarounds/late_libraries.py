"""Load a package's shared libraries when this process first imports the package, and not earlier.

The loader reads LD_LIBRARY_PATH only when the process starts, but it finds a loaded library by its name. A library
cannot be unloaded, so it is loaded as late as possible: a new build may replace a faulty one before the import.
"""

from __future__ import annotations

import ctypes
import sys
from collections.abc import Sequence
from importlib.abc import MetaPathFinder
from importlib.machinery import ModuleSpec
from pathlib import Path
from types import ModuleType


def load_on_import(package: str, folder: Path) -> None:
    """Load the libraries in `folder` when `package` is imported; a later call for the package replaces the folder."""
    _finder.folders[package] = folder
    if _finder not in sys.meta_path:
        sys.meta_path.insert(0, _finder)


class _Finder(MetaPathFinder):
    """Loads the libraries when the import system searches for the package; never finds a module itself."""

    def __init__(self) -> None:
        self.folders: dict[str, Path] = {}

    def find_spec(
        self, name: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        if name in self.folders:
            for library in sorted(self.folders[name].glob("*.so")):
                ctypes.CDLL(str(library))
        return None


_finder = _Finder()
