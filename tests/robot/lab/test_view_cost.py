"""The rate and the cost of the live picture, as `course bench` measures them."""

from __future__ import annotations

from pathlib import Path

import pytest
from kernels import CellError, Kernel

TESTS = Path(__file__).resolve().parents[2]
MEASURE = (
    f"import sys; sys.path.append({str(TESTS)!r}); "
    "from bench.view_cost import view_cost; cost = view_cost(seconds=1.5, rounds=1)"
)


def test_different_pictures_are_counted_and_the_simulation_keeps_its_pace(own_kernel: Kernel) -> None:
    try:
        own_kernel.run(MEASURE)
    except CellError as error:
        if error.name == "NoOpenGLError":
            pytest.skip(str(error))
        raise
    frames, pace, share, drawing = map(
        float,
        own_kernel.run(
            "print(cost.frames, cost.watched.pace, cost.watched.simulator_share,"
            " cost.watched.notebook - cost.without.notebook)"
        ).split(),
    )
    assert 0 < frames < 20  # odom comes 20 times a second
    assert 0.1 < pace < 3  # a strained machine delays /clock
    assert 0 < share < 1.1
    assert drawing > 0
    assert own_kernel.children() == []


def test_without_opengl_it_says_what_to_install(own_kernel: Kernel) -> None:
    own_kernel.run("import os; os.environ.update(MUJOCO_GL='egl', MUJOCO_EGL_DEVICE_ID='99')")
    with pytest.raises(CellError, match=r"NoOpenGLError: No picture: no OpenGL .*install libegl1"):
        own_kernel.run(MEASURE)
    assert own_kernel.children() == []
