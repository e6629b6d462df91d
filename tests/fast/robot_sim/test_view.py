"""Pictures without a screen."""

import os
import subprocess
import sys
from ctypes.util import find_library

import numpy as np
import pytest

from robot_sim.humanoid import Humanoid
from robot_sim.views.view import View, snapshot

ACCENT = (0.15, 0.45, 0.75)  # the blue plate on the chest, RGB


def test_a_snapshot_shows_the_robot():
    picture = snapshot(Humanoid(), 320, 240, camera="front")
    assert picture.shape == (240, 320, 3)
    assert picture.dtype == np.uint8
    middle = picture[60:130, 130:190].reshape(-1, 3).astype(float)
    blue = middle[:, 2] > 1.5 * middle[:, 0]
    white = middle.min(axis=1) > 150
    assert blue.sum() > 50
    assert white.sum() > 200


def test_a_view_follows_the_motion():
    humanoid = Humanoid()
    view = View(humanoid, 160, 120)
    before = view.picture("side")
    humanoid.set_motor_power(False)
    for _ in range(100):
        humanoid.step()
    after = view.picture("side")
    view.close()
    assert (before != after).any(axis=2).mean() > 0.02


def test_a_dot_lies_on_the_floor_where_it_is_put():
    humanoid = Humanoid()
    view = View(humanoid, 160, 120)
    without = view.picture("side").astype(int)
    ahead = view.picture("side", dots=[(0.5, 0.0, "#B34700")])
    afterwards = view.picture("side")
    view.close()
    rows, columns = np.nonzero(abs(without - ahead).max(axis=2) > 20)
    assert 10 < len(rows) < 400
    assert columns.min() > 80  # on the right, where the robot looks
    assert rows.min() > 60  # below the middle
    assert abs(without - afterwards).max() <= 20  # an earlier dot is gone


def test_an_unknown_camera_is_refused_with_the_known_ones():
    with pytest.raises(ValueError, match=r"'roof' is not known.*track.*head_camera"):
        snapshot(Humanoid(), 64, 48, camera="roof")


def draw_with(**variables):
    """Draw in a new process with these variables set; it prints the backend that was found."""
    others = {
        name: value for name, value in os.environ.items() if name not in ("MUJOCO_GL", "PYOPENGL_PLATFORM")
    }
    program = (
        "import os; from robot_sim.humanoid import Humanoid; from robot_sim.views.view import snapshot;"
        "print(snapshot(Humanoid(), 64, 48).std() > 5, os.environ['MUJOCO_GL'])"
    )
    return subprocess.run(
        [sys.executable, "-c", program],
        env=others | variables,
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )


def test_a_backend_that_needs_a_screen_is_set_aside():
    outcome = draw_with(MUJOCO_GL="glfw")
    assert outcome.stdout.split() in (["True", "egl"], ["True", "osmesa"]), outcome.stderr


@pytest.mark.skipif(find_library("OSMesa") is None, reason="there is no OSMesa (package libosmesa6)")
def test_osmesa_draws_where_egl_has_no_device():
    outcome = draw_with(MUJOCO_EGL_DEVICE_ID="99")
    assert outcome.stdout.split() == ["True", "osmesa"], outcome.stderr
