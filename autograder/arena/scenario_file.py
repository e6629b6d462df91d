"""Loads the scenarios of an exercise from its one file; the arena knows only the path."""

from __future__ import annotations

import importlib.util
import sys
from functools import cache
from types import ModuleType

NAME = "scenarios_of_the_exercise"


@cache
def scenarios_in(path: str) -> ModuleType:
    """Import the file, once in this process and its forks, and return the module."""
    spec = importlib.util.spec_from_file_location(NAME, path)
    assert spec
    assert spec.loader
    module = importlib.util.module_from_spec(spec)
    sys.modules[NAME] = module  # dataclasses look up their module in sys.modules
    spec.loader.exec_module(module)
    return module
