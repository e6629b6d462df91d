"""The tier of each test, by its first folder, and the order in which the files start."""

from __future__ import annotations

import math
from collections import Counter
from pathlib import Path

import pytest

TESTS = Path(__file__).parent
# The longest files start first. Then come robots and chapters, which mostly wait for their clocks while the submissions
# of test_audit.py use the processor. Files that use the processor themselves follow, and the fast tier's short ones.
FIRST = ("test_bare_debian.py", "test_audit.py", "test_notebooks_run.py")
TIERS = ("robot", "arena", "browser", "fast")


def tier_of(file: Path) -> str:
    """The folder below tests/ in which a file is."""
    return file.relative_to(TESTS).parts[0]


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(
        "--audit-minutes",
        type=float,
        default=math.inf,
        metavar="MINUTES",
        help="skip the known submissions whose grading has not begun after so long",
    )
    parser.addoption(
        "--long-fuzz",
        action="store_true",
        help="try a thousand times as many inputs in tests/fast/fuzz; --hypothesis-seed chooses them",
    )


def pytest_configure() -> None:
    files = Counter(file.name for file in TESTS.rglob("test_*.py"))
    if twice := sorted(name for name, times in files.items() if times > 1):
        raise pytest.UsageError(
            f"{', '.join(twice)}: pytest needs another name for each file, also across folders"
        )
    stray = [str(file) for file in sorted(TESTS.rglob("test_*.py")) if tier_of(file) not in TIERS]
    if stray:
        folders = ", ".join(f"tests/{tier}" for tier in TIERS)
        raise pytest.UsageError(f"{', '.join(stray)}: belongs to no tier; move it below one of {folders}")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    for item in items:
        if item.path.is_relative_to(TESTS):
            item.add_marker(tier_of(item.path))
    items.sort(key=lambda item: turn_of(item.path))


def turn_of(file: Path) -> int:
    """The position of a file in the order of starts, as a number to sort by."""
    if file.name in FIRST:
        return FIRST.index(file.name)
    return len(FIRST) + (TIERS.index(tier_of(file)) if file.is_relative_to(TESTS) else len(TIERS))
