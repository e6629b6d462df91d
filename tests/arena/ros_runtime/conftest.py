import subprocess
import sys
from pathlib import Path

import pytest

from ros_runtime.workarounds.scaled_clock.clock import ScaledClock
from ros_runtime.workarounds.scaled_clock.compile_library import compile_library


@pytest.fixture(scope="session")
def clock_library(tmp_path_factory):
    """The preloaded library, compiled from the present source."""
    library = tmp_path_factory.mktemp("clock") / "libscaled_clock.so"
    compile_library(library)
    return library


@pytest.fixture
def clock(tmp_path, clock_library):
    return ScaledClock.create(tmp_path / "clock_page", library=clock_library)


@pytest.fixture
def start():
    """Start a Python process with pipes; it is ended with the test."""
    processes = []

    def start(*arguments, environment):
        command = [sys.executable, *map(str, arguments)]
        pipe = subprocess.PIPE
        process = subprocess.Popen(
            command,
            env=environment,
            stdin=pipe,
            stdout=pipe,
            stderr=pipe,
            text=True,
            cwd=Path(__file__).parent,
        )
        processes.append(process)
        return process

    yield start
    for process in processes:
        process.kill()
        process.communicate()
