"""The robot's view in a browser: it is reachable only from this machine, and it shows the robot."""

import io
import os
import signal
import socket
import subprocess
import sys
import time
from contextlib import contextmanager

import numpy as np
import pytest
from PIL import Image
from playwright.sync_api import sync_playwright

from chromium import CHROMIUM, DRAWING, needs_chromium
from g1 import ROBOTS
from ros_runtime.environment import ros_environment
from ros_runtime.ros_domain import ReservedDomain
from view_address import view_address

pytest.importorskip("mujoco.studio", reason="this MuJoCo is older than 4.0 and has no web viewer")

TIMEOUT = 60.0  # s


@pytest.fixture(scope="module")
def url():
    """The address of a robot's view, in a process of its own, because a process can open MuJoCo's viewer only once."""
    with viewed_robot() as (_, url):
        yield url


@contextmanager
def viewed_robot(*options):
    """Start a robot with a view; yield its process and the view's address, or "" if the process has ended."""
    command = [sys.executable, "-m", "robot_sim", "--view", *options]
    domain = ReservedDomain()
    environment = {
        **os.environ,
        **ros_environment(),
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        "ROS_DOMAIN_ID": str(domain.domain_id),
    }
    process = subprocess.Popen(
        command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    try:
        yield process, view_address(process, TIMEOUT)
    finally:
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=30)
        domain.release()


def port_of(url):
    return int(url.rstrip("/").rpartition(":")[2])


def test_it_listens_on_this_machine_alone(url):
    with socket.create_connection(("127.0.0.1", port_of(url)), timeout=5):
        pass
    # Every address of 127/8 reaches a socket that is bound to all interfaces.
    with pytest.raises(ConnectionRefusedError):
        socket.create_connection(("127.0.0.2", port_of(url)), timeout=5).close()


def test_mujocos_own_functions_are_restored():
    program = (
        "from robot_sim.humanoid import Humanoid; from robot_sim.views.web_view import WebView;"
        "view = WebView(Humanoid());"
        "from mujoco.studio import web_viewer; from mujoco.studio.web import web_server;"
        "owners = (web_server.bind_public_socket.__module__, web_viewer._print_url_banner.__module__);"
        "import os; os.write(2, ' '.join(('\\nfrom', *owners, '\\n')).encode())"  # the viewer prints, too
    )
    ran = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, timeout=60, check=False
    )
    expected = "from mujoco.studio.web.web_server mujoco.studio.web_viewer"
    assert expected in map(str.strip, ran.stderr.splitlines()), ran.stdout + ran.stderr


def test_the_viewer_prints_no_lines():
    with viewed_robot() as (process, _):
        said = process.stdout.readline()
        process.send_signal(signal.SIGINT)
        left = process.stdout.read()
    assert said.startswith("humanoid stands in")
    assert left == ""


def test_a_taken_port_is_reported(url):
    with viewed_robot("--port", str(port_of(url))) as (process, _):
        assert f"Port {port_of(url)} is already in use" in process.stderr.read()
        assert process.wait(30) == 1


def test_ctrl_c_ends_a_robot_with_a_view():
    with viewed_robot() as (process, url):
        assert url.startswith("http://127.0.0.1:")
    assert process.returncode == 0


@needs_chromium
@pytest.mark.parametrize("robot", ROBOTS)
def test_a_browser_shows_the_robot(robot):
    with viewed_robot("--robot", robot) as (_, url), sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=DRAWING)
        page = browser.new_page(viewport={"width": 800, "height": 600})
        page.goto(url)
        deadline = time.monotonic() + TIMEOUT
        while not shows_the_robot(page.screenshot()):
            assert time.monotonic() < deadline, f"no robot is seen within {TIMEOUT:g} s"
        browser.close()


def shows_the_robot(screenshot):
    """Whether the picture has the blue of the robot's chest and its bright body, which nothing else has."""
    pixels = np.asarray(Image.open(io.BytesIO(screenshot)).convert("RGB")).astype(int)
    middle = pixels[50:450, 300:500].reshape(-1, 3)
    blue = middle[:, 2] > middle[:, 0] + 60
    bright = middle.min(axis=1) > 160
    return blue.sum() > 500 and bright.sum() > 300
