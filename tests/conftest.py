"""How the tests are shared out when two run at a time: a file stays together, and so do the chapters.

The two longest groups begin first: the known submissions, and the chapters, which are executed once for their tests.
"""

from __future__ import annotations

import pytest

FIRST = ("test_audit.py", "chapters")


def pytest_itemcollected(item: pytest.Item) -> None:
    item.add_marker(pytest.mark.xdist_group(_group(item)))


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    items.sort(key=lambda item: FIRST.index(_group(item)) if _group(item) in FIRST else len(FIRST))


def _group(item: pytest.Item) -> str:
    return "chapters" if item.path.parent.name == "chapters" else item.path.name
