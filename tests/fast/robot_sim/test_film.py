"""Films without a screen."""

import io

import numpy as np
import pytest
from PIL import Image, ImageSequence

from robot_sim.humanoid import Humanoid
from robot_sim.views.film import Reel, film


def test_a_film_plays_the_motion_at_the_pace_of_the_simulation(tmp_path):
    humanoid = Humanoid()
    humanoid.walk_velocity(0.3, 0.0, 0.0)
    film(humanoid, 1.2, tmp_path / "walk.webp", camera="side")
    assert humanoid.time == pytest.approx(1.16, abs=0.01)  # the last of 30 frames
    with Image.open(tmp_path / "walk.webp") as moving:
        frames = [np.asarray(frame.convert("RGB")).astype(int) for frame in ImageSequence.Iterator(moving)]
        assert moving.info["duration"] == 40  # ms
    assert len(frames) == 30
    legs = np.array(frames)[:, 200:330]
    assert (abs(legs[-1] - legs[0]) > 40).mean() > 0.005


def test_commands_can_be_given_while_it_is_filmed():
    humanoid = Humanoid()
    pushed = []

    def push_once():
        if humanoid.time >= 0.1 and not pushed:
            pushed.append(humanoid.time)
            humanoid.set_motor_power(False)

    film(humanoid, 0.4, io.BytesIO(), each_step=push_once)
    assert pushed == [pytest.approx(0.1, abs=0.01)]
    assert not humanoid.motors_enabled


@pytest.mark.parametrize("seconds", [0.0, -1.0, float("nan")])
def test_a_film_without_a_duration_is_refused(seconds):
    with pytest.raises(ValueError, match="expected a positive number"):
        film(Humanoid(), seconds, io.BytesIO())


def test_an_empty_reel_is_refused():
    reel = Reel(Humanoid(), 64, 48)
    with pytest.raises(ValueError, match="there are no frames"):
        reel.save(io.BytesIO())
    reel.close()
