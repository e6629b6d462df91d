"""What keeps the fast tier fast: its tests cannot start what belongs to another tier."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest

SLOW_PROGRAMS = {"bwrap", "chromium"}
SLOW_MODULES = {"robot_sim", "ipykernel_launcher", "jupyter"}  # python -m …


class TooSlowForThisTier(Exception):
    """A fast test started a sandbox, a robot, a kernel or a browser."""


def slow_part(command: Any) -> str | None:
    """The word of a command that makes it slow, or None."""
    words = [command] if isinstance(command, (str, bytes, os.PathLike)) else command
    program, *arguments = map(os.fsdecode, words)
    modules = [word for option, word in pairwise(arguments) if option == "-m"]
    slow = [*({Path(program).name} & SLOW_PROGRAMS), *(set(modules) & SLOW_MODULES)]
    return slow[0] if slow else None


@pytest.fixture(autouse=True, scope="module")
def only_light_processes() -> Iterator[None]:
    """Refuse slow programs at their start."""
    start = subprocess.Popen.__init__

    def start_if_light(self: subprocess.Popen, args: Any, *rest: Any, **options: Any) -> None:
        if slow := slow_part(args):
            raise TooSlowForThisTier(f"{slow}: move this test to tests/arena, tests/robot or tests/browser")
        start(self, args, *rest, **options)

    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(subprocess.Popen, "__init__", start_if_light)
        yield
