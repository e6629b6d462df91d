"""In which order the tests begin: the longest files first, so that two workers end at about the same time."""

from __future__ import annotations

import pytest

FIRST = ("test_audit.py", "test_form.py")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    items.sort(key=lambda item: FIRST.index(item.path.name) if item.path.name in FIRST else len(FIRST))
