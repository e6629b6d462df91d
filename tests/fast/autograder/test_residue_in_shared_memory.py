"""Shared memory that a node leaves behind is detected; memory that another node uses is not."""

from __future__ import annotations

import subprocess
import sys
import uuid
from collections.abc import Iterator
from pathlib import Path

import pytest

from leftovers import leftovers

SHARED_MEMORY = Path("/dev/shm")
MAPS = """
import mmap, sys
with open(sys.argv[1], "wb+") as file:
    file.truncate(4096)
    memory = mmap.mmap(file.fileno(), 4096)
print("mapped", flush=True)
input()
"""

pytestmark = pytest.mark.skipif(
    not SHARED_MEMORY.is_dir(), reason="this system has no shared memory in files"
)


@pytest.fixture
def path() -> Iterator[Path]:
    path = SHARED_MEMORY / f"fastrtps_of_a_test_{uuid.uuid4().hex}"
    yield path
    path.unlink(missing_ok=True)


def test_what_tracing_keeps_for_each_user_of_the_machine_is_not_left_behind() -> None:
    path = SHARED_MEMORY / f"lttng-ust-wait-6-{uuid.uuid4().int % 10**9}"
    try:
        with leftovers(timeout=0.0) as left:
            path.write_bytes(b"")  # as when another user's first node starts
    finally:
        path.unlink(missing_ok=True)
    assert f"file {path}" not in left


def test_a_file_is_left_behind_when_nobody_uses_it_any_more(path: Path) -> None:
    with leftovers(timeout=0.0) as at_the_end:
        with leftovers(timeout=0.0) as in_use:
            node = subprocess.Popen(
                [sys.executable, "-c", MAPS, str(path)], stdin=subprocess.PIPE, stdout=subprocess.PIPE
            )
            assert node.stdout
            assert node.stdout.readline() == b"mapped\n"
        node.communicate(b"\n")
    assert f"file {path}" not in in_use
    assert f"file {path}" in at_the_end
