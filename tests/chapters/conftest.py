"""The chapters, each executed once."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from execution import Executed, execute


@pytest.fixture(scope="session")
def executed(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Executed]:
    """`executed("02_services")` is that chapter after its run, which is made only once."""
    done: dict[str, Executed | Exception] = {}

    def run_once(name: str) -> Executed:
        if name not in done:
            try:
                done[name] = execute(name, tmp_path_factory.mktemp(name))
            except Exception as error:  # a failed run is not repeated for each test
                done[name] = error
        chapter = done[name]
        if isinstance(chapter, Exception):
            raise chapter
        return chapter

    return run_once
