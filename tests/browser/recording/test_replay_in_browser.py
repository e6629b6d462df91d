"""The replay of a lost point in the web view: the robot, and below it captions of the events and the failed check."""

from __future__ import annotations

import io
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from playwright.sync_api import ViewportSize, sync_playwright

from chromium import CHROMIUM, DRAWING, needs_chromium
from falls import recorded_fall
from view_address import view_address

pytest.importorskip("mujoco.studio", reason="this MuJoCo is older than 4.0 and has no web viewer")

# px: drawing costs by the pixel without a graphics card
VIEWPORT: ViewportSize = {"width": 640, "height": 420}
TIMEOUT = 60.0  # s
RED = np.array([0xFF, 0x7B, 0x72])  # of the caption of a failed check

pytestmark = needs_chromium


@pytest.fixture
def url(tmp_path: Path) -> Iterator[str]:
    """The address at which `course replay` shows a robot that falls."""
    command = [Path(sys.executable).with_name("course"), "replay", recorded_fall(tmp_path, "flat")]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as process:
        yield view_address(process, TIMEOUT)
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=30)


def test_the_captions_stand_over_the_floor_and_the_failed_check_is_red(url: str) -> None:
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=DRAWING)
        page = browser.new_page(viewport=VIEWPORT)
        page.goto(url)
        deadline = time.monotonic() + TIMEOUT
        while red_letters(page.screenshot()) < 100:
            assert time.monotonic() < deadline, f"no red caption is seen within {TIMEOUT:g} s"
        browser.close()


def red_letters(screenshot: bytes) -> int:
    """Count the pixels of that red in the lower half."""
    pixels = np.asarray(Image.open(io.BytesIO(screenshot)).convert("RGB")).astype(int)
    return int((abs(pixels[VIEWPORT["height"] // 2 :] - RED) < 40).all(axis=2).sum())
