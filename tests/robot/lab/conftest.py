"""Kernels for the tests of the lab."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from kernels import Kernel


@pytest.fixture(scope="module")
def kernel(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Kernel]:
    """One kernel for the tests of a file; each stops what it started."""
    running = Kernel(tmp_path_factory.mktemp("notebook"))
    yield running
    running.shut_down()


@pytest.fixture
def own_kernel(tmp_path: Path) -> Iterator[Kernel]:
    """A kernel that the test may harm."""
    running = Kernel(tmp_path)
    yield running
    running.shut_down()
