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


@pytest.mark.parametrize("camera", ["side", "track", "front"])
def test_a_point_of_the_world_is_found_in_the_picture(camera):
    def see(humanoid):
        view = View(humanoid, 320, 240, shadows=False)
        picture = view.picture(camera).astype(int)
        place = view.pixel_of(humanoid.data.geom("head").xpos)
        view.close()
        return picture, place

    humanoid = Humanoid()
    white, place = see(humanoid)
    humanoid.model.geom("head").rgba = (1, 0, 0, 1)
    red, _ = see(humanoid)
    rows, columns = np.nonzero(abs(white - red).max(axis=2) > 60)
    assert place == pytest.approx((columns.mean(), rows.mean()), abs=6)


def test_an_unknown_camera_is_refused_with_the_known_ones():
    with pytest.raises(ValueError, match=r"'roof' is not known.*track.*head_camera"):
        snapshot(Humanoid(), 64, 48, camera="roof")


def draw_with(**variables):
    """Draw in a new process with these environment variables; it prints the backend that was used."""
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


def test_a_backend_that_needs_a_screen_is_ignored():
    outcome = draw_with(MUJOCO_GL="glfw")
    assert outcome.stdout.split() in (["True", "egl"], ["True", "osmesa"]), outcome.stderr


@pytest.mark.skipif(find_library("OSMesa") is None, reason="there is no OSMesa (package libosmesa6)")
def test_osmesa_draws_where_egl_has_no_device():
    outcome = draw_with(MUJOCO_EGL_DEVICE_ID="99")
    assert outcome.stdout.split() == ["True", "osmesa"], outcome.stderr
