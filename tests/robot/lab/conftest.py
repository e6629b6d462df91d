"""Kernels for tests of the lab."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest
from kernels import Kernel

NODES = Path(__file__).with_name("nodes")


@pytest.fixture(scope="module")
def kernel(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Kernel]:
    """One kernel for the tests of a file; each test stops the processes that it started."""
    running = Kernel(shutil.copytree(NODES, tmp_path_factory.mktemp("notebook"), dirs_exist_ok=True))
    yield running
    running.shut_down()


@pytest.fixture
def own_kernel(tmp_path: Path) -> Iterator[Kernel]:
    """A kernel for one test, which may kill it."""
    running = Kernel(shutil.copytree(NODES, tmp_path, dirs_exist_ok=True))
    yield running
    running.shut_down()
