"""The processor time of a build is limited, whichever of its processes uses it."""

from __future__ import annotations

import subprocess
import sys

import pytest

LIMITED = """
import subprocess, sys
from ros_runtime.interface_build.__main__ import BuildTooLong, limit_processor_time
try:
    with limit_processor_time(1):
        {work}
except BuildTooLong as error:
    print(error)
"""
OWN_WORK = """
        while True:
            try:
                sum(range(10**6))
            except Exception:  # as parsers do
                pass
"""
WORK_OF_A_CHILD = """
        subprocess.run([sys.executable, "-c", "while True: pass"])
        raise RuntimeError("the compiler failed")
"""


@pytest.mark.parametrize("work", [OWN_WORK, WORK_OF_A_CHILD], ids=["its own", "a child's"])
def test_an_endless_build_is_ended_and_reported(work: str) -> None:
    program = LIMITED.format(work=work.strip())
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60)
    assert ended.stdout == "building it takes more than 1 s\n", ended.stderr


def test_another_failure_within_the_limit_is_reported_unchanged() -> None:
    program = LIMITED.format(work='raise RuntimeError("no compiler")')
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60)
    assert "RuntimeError: no compiler" in ended.stderr
