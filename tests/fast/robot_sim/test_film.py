"""Films of pictures."""

import numpy as np
import pytest
from PIL import Image, ImageSequence

from robot_sim.views.film import save_frames

FRAMES = [Image.fromarray(np.full((36, 48, 3), level, np.uint8)) for level in (20, 120, 220)]


@pytest.mark.parametrize("kind", ["WEBP", "GIF"])
def test_a_film_has_every_frame_at_its_rate_and_shows_the_last_one_longer(tmp_path, kind):
    save_frames(tmp_path / "film", FRAMES, kind, 25.0, last=2.0)
    with Image.open(tmp_path / "film") as moving:
        shown = []
        for frame in ImageSequence.Iterator(moving):
            frame.load()
            shown.append((np.asarray(frame.convert("L")).mean(), moving.info["duration"]))
    assert [level for level, _ in shown] == pytest.approx([20, 120, 220], abs=4)
    assert [duration for _, duration in shown] == [40, 40, 2040]  # ms
